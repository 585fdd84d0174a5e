#include "weft/view/gl/canvas.h"

#include <algorithm>

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

}  // namespace

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
