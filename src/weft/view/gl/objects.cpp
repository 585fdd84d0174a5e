#include "weft/view/gl/objects.h"

#include <algorithm>
#include <array>
#include <string>

#include "weft/core/assert.h"
#include "weft/error.h"

namespace weft::gl {
namespace {

Renderbuffer attach(GLenum place, GLenum format, int count, std::array<int, 2> size) {
  GLuint name = 0;
  glGenRenderbuffers(1, &name);
  Renderbuffer buffer(name);
  glBindRenderbuffer(GL_RENDERBUFFER, name);
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, count, format, size[0], size[1]);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, name);
  return buffer;
}

constexpr std::size_t longest_log = 4096;

void set_texture_defaults(GLenum target) {
  glTexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(target, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(target, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

Handle<free_texture> make_texture() {
  GLuint name = 0;
  glGenTextures(1, &name);
  return Handle<free_texture>(name);
}

/// Errors are one line: the log up to its first line break.
[[noreturn]] void fail(std::string_view program, std::string_view what, std::string log) {
  log.resize(std::min(log.find('\n'), log.find('\0')));
  throw Error(ExitCode::internal, std::string("shader ").append(program), std::string(what) + log,
              "a driver for OpenGL 3.3 core is wanted");
}

struct Shader {
  GLuint name;
  Shader(GLenum kind, std::string_view program, std::string_view text)
      : name(glCreateShader(kind)) {
    const char* data = text.data();
    const auto length = static_cast<GLint>(text.size());
    glShaderSource(name, 1, &data, &length);
    glCompileShader(name);
    GLint good = GL_FALSE;
    glGetShaderiv(name, GL_COMPILE_STATUS, &good);
    if (good == GL_TRUE) return;
    std::string log(longest_log, '\0');
    glGetShaderInfoLog(name, static_cast<GLsizei>(log.size()), nullptr, log.data());
    glDeleteShader(name);
    fail(program, "does not compile: ", std::move(log));
  }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  ~Shader() { glDeleteShader(name); }
};

}  // namespace

void free_texture(GLuint name) { glDeleteTextures(1, &name); }
void free_framebuffer(GLuint name) { glDeleteFramebuffers(1, &name); }
void free_renderbuffer(GLuint name) { glDeleteRenderbuffers(1, &name); }
void free_buffer(GLuint name) { glDeleteBuffers(1, &name); }
void free_vertex_array(GLuint name) { glDeleteVertexArrays(1, &name); }
void free_program(GLuint name) { glDeleteProgram(name); }
void free_sampler(GLuint name) { glDeleteSamplers(1, &name); }

Framebuffer make_framebuffer() {
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  return Framebuffer(name);
}

VertexArray make_vertex_array() {
  GLuint name = 0;
  glGenVertexArrays(1, &name);
  return VertexArray(name);
}

Buffer make_buffer() {
  GLuint name = 0;
  glGenBuffers(1, &name);
  return Buffer(name);
}

Texture::Texture(GLenum format, int width, int height)
    : handle_(make_texture()), width_(width), height_(height) {
  glBindTexture(GL_TEXTURE_2D, name());
  const bool depth = format == GL_DEPTH_COMPONENT32F;
  glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format), width, height, 0,
               depth ? GL_DEPTH_COMPONENT : GL_RGB, GL_FLOAT, nullptr);
  set_texture_defaults(GL_TEXTURE_2D);
}

void Texture::upload(std::span<const Vec3f> texels) {
  static_assert(sizeof(Vec3f) == 3 * sizeof(float));
  WEFT_ASSERT(texels.size() == static_cast<std::size_t>(width_) * height_);
  glBindTexture(GL_TEXTURE_2D, name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, GL_RGB, GL_FLOAT, texels.data());
}

void Texture::bind(int unit) const {
  glActiveTexture(GL_TEXTURE0 + unit);
  glBindTexture(GL_TEXTURE_2D, name());
}

DepthLayers::DepthLayers(int size, int layers)
    : handle_(make_texture()), target_(make_framebuffer()), size_(size) {
  glBindTexture(GL_TEXTURE_2D_ARRAY, handle_.name());
  glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_DEPTH_COMPONENT32F, size, size, layers, 0,
               GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
  set_texture_defaults(GL_TEXTURE_2D_ARRAY);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
}

void DepthLayers::begin(int layer) const {
  glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
  glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, handle_.name(), 0, layer);
  glDrawBuffer(GL_NONE);
  glViewport(0, 0, size_, size_);
  glClear(GL_DEPTH_BUFFER_BIT);
}

void DepthLayers::bind(int unit) const {
  glActiveTexture(GL_TEXTURE0 + unit);
  glBindTexture(GL_TEXTURE_2D_ARRAY, handle_.name());
}

Program::Program(std::string_view name, std::string_view vertex, std::string_view fragment) {
  const Shader first(GL_VERTEX_SHADER, name, vertex);
  const Shader second(GL_FRAGMENT_SHADER, name, fragment);
  handle_ = Handle<free_program>(glCreateProgram());
  glAttachShader(handle_.name(), first.name);
  glAttachShader(handle_.name(), second.name);
  glLinkProgram(handle_.name());
  GLint good = GL_FALSE;
  glGetProgramiv(handle_.name(), GL_LINK_STATUS, &good);
  if (good == GL_TRUE) return;
  std::string log(longest_log, '\0');
  glGetProgramInfoLog(handle_.name(), static_cast<GLsizei>(log.size()), nullptr, log.data());
  fail(name, "does not link: ", std::move(log));
}

void Program::use() const { glUseProgram(handle_.name()); }
GLint Program::location(const char* name) const {
  return glGetUniformLocation(handle_.name(), name);
}
void Program::set(const char* name, int value) const { glUniform1i(location(name), value); }
void Program::set(const char* name, float value) const { glUniform1f(location(name), value); }
void Program::set(const char* name, Vec3f value) const {
  glUniform3f(location(name), value.x, value.y, value.z);
}
void Program::set_pair(const char* name, float x, float y) const {
  glUniform2f(location(name), x, y);
}
void Program::set(const char* name, const Matrix& value) const {
  set(name, std::span<const Matrix>(&value, 1));
}
void Program::set(const char* name, std::span<const Vec3f> values) const {
  glUniform3fv(location(name), static_cast<GLsizei>(values.size()), &values.data()->x);
}
void Program::set(const char* name, std::span<const Matrix> values) const {
  glUniformMatrix4fv(location(name), static_cast<GLsizei>(values.size()), GL_FALSE,
                     values.data()->data());
}

Canvas make_canvas(int count, std::array<int, 2> size) {
  Canvas canvas;
  canvas.target = make_framebuffer();
  glBindFramebuffer(GL_FRAMEBUFFER, canvas.target.name());
  canvas.colour = attach(GL_COLOR_ATTACHMENT0, GL_RGBA8, count, size);
  canvas.depth = attach(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, count, size);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw Error(ExitCode::internal, "OpenGL", "the driver cannot draw pictures of this size",
                "a smaller one is wanted");
  return canvas;
}

Picture read_picture(GLuint name, std::array<int, 2> size) {
  const std::size_t row = std::size_t{3} * size[0];
  Picture picture{size[0], size[1], std::vector<std::uint8_t>(row * size[1])};
  glBindFramebuffer(GL_READ_FRAMEBUFFER, name);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, size[0], size[1], GL_RGB, GL_UNSIGNED_BYTE, picture.rgb.data());
  // OpenGL counts rows from the bottom.
  for (int top = 0, bottom = size[1] - 1; top < bottom; ++top, --bottom)
    std::swap_ranges(picture.rgb.begin() + row * top, picture.rgb.begin() + row * (top + 1),
                     picture.rgb.begin() + row * bottom);
  return picture;
}

}  // namespace weft::gl
