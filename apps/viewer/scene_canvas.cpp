#include "apps/viewer/scene_canvas.h"

#include <algorithm>

namespace weft::viewer {
namespace {

constexpr int fine_samples = 4;

}  // namespace

void SceneCanvas::fit(std::array<int, 2> size, int samples) {
  if (size == size_ && samples == samples_) return;
  canvas_ = gl::make_canvas(samples, size);
  size_ = size;
  samples_ = samples;
}

void SceneCanvas::paint(const DrawnScene& scene, std::array<int, 2> size, int pixel) {
  fit({std::max(1, size[0] / pixel), std::max(1, size[1] / pixel)}, pixel == 1 ? fine_samples : 0);
  painter_.paint(scene, {canvas_.target.name(), size_[0], size_[1]});
  glBindFramebuffer(GL_READ_FRAMEBUFFER, canvas_.target.name());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glBlitFramebuffer(0, 0, size_[0], size_[1], 0, 0, size[0], size[1], GL_COLOR_BUFFER_BIT,
                    pixel == 1 ? GL_NEAREST : GL_LINEAR);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, size[0], size[1]);
}

}  // namespace weft::viewer
