#pragma once

#include <array>
#include <span>
#include <string_view>
#include <utility>

#include <epoxy/gl.h>

#include "weft/picture.h"
#include "weft/vec.h"
#include "weft/view/gl/matrix.h"

namespace weft::gl {

/// Owns an OpenGL object name; 0 is none. Freed by `Free`, with the context current.
template <void (*Free)(GLuint)>
class Handle {
 public:
  Handle() = default;
  explicit Handle(GLuint name) : name_(name) {}
  Handle(Handle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (name_ != 0) Free(name_);
  }
  [[nodiscard]] GLuint name() const { return name_; }

 private:
  GLuint name_ = 0;
};

void free_texture(GLuint name);
void free_framebuffer(GLuint name);
void free_renderbuffer(GLuint name);
void free_buffer(GLuint name);
void free_vertex_array(GLuint name);
void free_program(GLuint name);
void free_sampler(GLuint name);

using Framebuffer = Handle<free_framebuffer>;
using Renderbuffer = Handle<free_renderbuffer>;
using Buffer = Handle<free_buffer>;
using VertexArray = Handle<free_vertex_array>;
using Sampler = Handle<free_sampler>;

Framebuffer make_framebuffer();
VertexArray make_vertex_array();
Buffer make_buffer();

/// A 2D texture, clamped at its edges and filtered linearly.
class Texture {
 public:
  Texture() = default;
  /// @param format  sized internal format, for example GL_RGB32F
  Texture(GLenum format, int width, int height);
  [[nodiscard]] GLuint name() const { return handle_.name(); }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// Replaces all texels. @param texels  [height x width], rows in order, three floats each
  void upload(std::span<const Vec3f> texels);
  void bind(int unit) const;

 private:
  Handle<free_texture> handle_;
  int width_ = 0, height_ = 0;
};

/// An array texture of depth maps, rendered layer by layer and sampled with comparison.
class DepthLayers {
 public:
  DepthLayers(int size, int layers);
  [[nodiscard]] int size() const { return size_; }
  /// Makes the layer the render target and clears it.
  void begin(int layer) const;
  void bind(int unit) const;

 private:
  Handle<free_texture> handle_;
  Framebuffer target_;
  int size_;
};

/// A linked pair of shaders and its uniform values. Unknown names are ignored, as OpenGL does.
class Program {
 public:
  /// @throws Error with the compiler's first message
  Program(std::string_view name, std::string_view vertex, std::string_view fragment);
  void use() const;
  void set(const char* name, int value) const;
  void set(const char* name, float value) const;
  void set(const char* name, Vec3f value) const;
  void set_pair(const char* name, float x, float y) const;
  void set(const char* name, const Matrix& value) const;
  void set(const char* name, std::span<const Vec3f> values) const;
  void set(const char* name, std::span<const Matrix> values) const;

 private:
  [[nodiscard]] GLint location(const char* name) const;
  Handle<free_program> handle_;
};

/// A framebuffer with colour and depth.
struct Canvas {
  Framebuffer target;
  Renderbuffer colour, depth;
};
/// @param count  samples a pixel; 0 for one without averaging
/// @param size   width and height [pixels]
/// @throws Error when the driver cannot draw pictures of this size
Canvas make_canvas(int count, std::array<int, 2> size);

/// Reads the pixels of a framebuffer, top row first. @param name  0: the window's own
/// @param size  width and height [pixels]
Picture read_picture(GLuint name, std::array<int, 2> size);

}  // namespace weft::gl
