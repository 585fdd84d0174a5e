#include "apps/viewer/image_texture.h"

#include <algorithm>

#include "weft/view/camera.h"

namespace weft::viewer {

void ImageTexture::load(const Planes3& positions) {
  const int n = positions.size();
  if (texture_.width() != n) texture_ = gl::Texture(GL_RGB32F, n, n);
  const Box3d box = bounds(positions);
  const Vec3d extent = box.empty() ? Vec3d{1, 1, 1} : box.extent();
  const double side = std::max({extent.x, extent.y, extent.z, 1e-9});
  const auto scale = static_cast<float>(1 / side);
  const auto lower = vec_cast<float>(box.empty() ? Vec3d{} : box.lower);
  texels_.clear();
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) texels_.push_back(scale * (positions.at(r, c) - lower));
  texture_.upload(texels_);
}

}  // namespace weft::viewer
