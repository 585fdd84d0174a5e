#include "weft/view/renderer.h"

#include <algorithm>

#include "weft/core/error.h"
#include "weft/view/gl/context.h"
#include "weft/view/gl/scene_painter.h"

namespace weft {
namespace {

constexpr int samples = 4;
constexpr int largest_side = 16384;

/// A colour and a depth buffer to draw to. @param count  samples a pixel; 0 for one without
/// averaging
struct Canvas {
  gl::Framebuffer target;
  gl::Renderbuffer colour, depth;
};

gl::Renderbuffer attach(GLenum place, GLenum format, int count, std::array<int, 2> size) {
  GLuint name = 0;
  glGenRenderbuffers(1, &name);
  gl::Renderbuffer buffer(name);
  glBindRenderbuffer(GL_RENDERBUFFER, name);
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, count, format, size[0], size[1]);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, name);
  return buffer;
}

Canvas make_canvas(int count, std::array<int, 2> size) {
  Canvas canvas;
  canvas.target = gl::make_framebuffer();
  glBindFramebuffer(GL_FRAMEBUFFER, canvas.target.name());
  canvas.colour = attach(GL_COLOR_ATTACHMENT0, GL_RGBA8, count, size);
  canvas.depth = attach(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, count, size);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw Error(ExitCode::internal, "OpenGL", "the driver cannot draw pictures of this size",
                "a smaller one is wanted");
  return canvas;
}

std::array<int, 2> checked_size(int width, int height) {
  if (std::min(width, height) < 1 || std::max(width, height) > largest_side)
    throw Error(ExitCode::usage, "picture size", "a side is out of range",
                "1 to 16384 pixels are wanted");
  return {width, height};
}

}  // namespace

struct Renderer::Device {
  std::array<int, 2> size;
  gl::Context context;
  gl::ScenePainter painter;
  Canvas drawn, averaged;

  Device(int width, int height)
      : size(checked_size(width, height)),
        drawn(make_canvas(samples, size)),
        averaged(make_canvas(0, size)) {}
};

Renderer::Renderer(int width, int height) : device_(std::make_unique<Device>(width, height)) {}

Renderer::~Renderer() {
  // Freed with the right context: there may be another renderer on this thread.
  if (device_) device_->context.make_current();
}

Picture Renderer::draw(const DrawnScene& scene) {
  Device& device = *device_;
  const auto [width, height] = device.size;
  device.context.make_current();
  device.painter.paint(scene, {device.drawn.target.name(), width, height});
  glBindFramebuffer(GL_READ_FRAMEBUFFER, device.drawn.target.name());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, device.averaged.target.name());
  glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, device.averaged.target.name());
  Picture picture{width, height, std::vector<std::uint8_t>(std::size_t{3} * width * height)};
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, picture.rgb.data());
  // OpenGL counts rows from the bottom.
  const std::size_t row = std::size_t{3} * width;
  for (int top = 0, bottom = height - 1; top < bottom; ++top, --bottom)
    std::swap_ranges(picture.rgb.begin() + row * top, picture.rgb.begin() + row * (top + 1),
                     picture.rgb.begin() + row * bottom);
  return picture;
}

}  // namespace weft
