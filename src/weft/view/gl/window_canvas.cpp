#include "weft/window_canvas.h"

#include <algorithm>
#include <vector>

#include "weft/camera.h"
#include "weft/view/gl/objects.h"
#include "weft/view/gl/scene_painter.h"

namespace weft {
namespace {

constexpr int fine_samples = 4;

}  // namespace

struct WindowCanvas::Device {
  gl::ScenePainter painter;
  gl::Canvas canvas;
  std::array<int, 2> size{};  // of the canvas
  int samples = -1;
  gl::Texture image;
  std::vector<Vec3f> texels;

  void fit(std::array<int, 2> wanted, int count) {
    if (wanted == size && count == samples) return;
    canvas = gl::make_canvas(count, wanted);
    size = wanted;
    samples = count;
  }
};

WindowCanvas::WindowCanvas() : device_(std::make_unique<Device>()) {}
WindowCanvas::~WindowCanvas() = default;

void WindowCanvas::paint(const DrawnScene& scene, std::array<int, 2> size, int pixel) {
  Device& device = *device_;
  device.fit({std::max(1, size[0] / pixel), std::max(1, size[1] / pixel)},
             pixel == 1 ? fine_samples : 0);
  const auto [width, height] = device.size;
  device.painter.paint(scene, {device.canvas.target.name(), width, height});
  glBindFramebuffer(GL_READ_FRAMEBUFFER, device.canvas.target.name());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glBlitFramebuffer(0, 0, width, height, 0, 0, size[0], size[1], GL_COLOR_BUFFER_BIT,
                    pixel == 1 ? GL_NEAREST : GL_LINEAR);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, size[0], size[1]);
}

unsigned WindowCanvas::load_image(const Planes3& positions) {
  const int n = positions.size();
  gl::Texture& image = device_->image;
  if (image.width() != n) image = gl::Texture(GL_RGB32F, n, n);
  const Box3d box = bounds(positions);
  const Vec3d extent = box.empty() ? Vec3d{1, 1, 1} : box.extent();
  const double side = std::max({extent.x, extent.y, extent.z, 1e-9});
  const auto scale = static_cast<float>(1 / side);
  const auto lower = vec_cast<float>(box.empty() ? Vec3d{} : box.lower);
  std::vector<Vec3f>& texels = device_->texels;
  texels.clear();
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) texels.push_back(scale * (positions.at(r, c) - lower));
  image.upload(texels);
  return image.name();
}

Picture WindowCanvas::read(std::array<int, 2> size) { return gl::read_picture(0, size); }

}  // namespace weft
