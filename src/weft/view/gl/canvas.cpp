#include "weft/view/gl/canvas.h"

#include "weft/core/error.h"

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

}  // namespace weft::gl
