#include "weft/mesh/io/gltf_texture_transform.h"

#include <cmath>
#include <vector>

namespace weft {
namespace {

Vec2d pair_of(const GltfObject& object, const char* key, Vec2d otherwise) {
  const std::vector<double> numbers = object.numbers(key, 2);
  return numbers.empty() ? otherwise : Vec2d{numbers[0], numbers[1]};
}

}  // namespace

GltfTextureTransform::GltfTextureTransform(const GltfObject& extension)
    : offset_(pair_of(extension, "offset", {})), scale_(pair_of(extension, "scale", {1, 1})) {
  const double rotation = extension.number("rotation").value_or(0);
  sine_ = std::sin(rotation);
  cosine_ = std::cos(rotation);
}

Vec2f GltfTextureTransform::operator()(Vec2f uv) const {
  const double u = scale_.x * uv.x, v = scale_.y * (1 - double{uv.y});
  const double across = cosine_ * u + sine_ * v + offset_.x;
  const double down = cosine_ * v - sine_ * u + offset_.y;
  return {static_cast<float>(across), static_cast<float>(1 - down)};
}

}  // namespace weft
