#include <algorithm>

#include "weft/drawing.h"
#include "weft/error.h"
#include "weft/view/gl/canvas.h"
#include "weft/view/gl/context.h"
#include "weft/view/gl/scene_painter.h"

namespace weft {
namespace {

constexpr int samples = 4;
constexpr int largest_side = 16384;

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
  gl::Canvas drawn, averaged;

  Device(int width, int height)
      : size(checked_size(width, height)),
        drawn(gl::make_canvas(samples, size)),
        averaged(gl::make_canvas(0, size)) {}
};

Renderer::Renderer(int width, int height) : device_(std::make_unique<Device>(width, height)) {}

Renderer::~Renderer() {
  // Resources are freed in their own context: another renderer of this thread may be current.
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
  return gl::read_picture(device.averaged.target.name(), {width, height});
}

}  // namespace weft
