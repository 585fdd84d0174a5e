#include "weft/geometry_image.h"

#include <bit>

namespace weft {
namespace {

bool same_bits(Vec3f a, Vec3f b) {
  const auto same = [](float p, float q) {
    return std::bit_cast<std::uint32_t>(p) == std::bit_cast<std::uint32_t>(q);
  };
  return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z);
}

}  // namespace

bool mates_bit_equal(const GeometryImage& image) {
  for (int k = 0; k < image.mates.class_count(); ++k) {
    const std::span<const int> mates = image.mates.mates(k);
    for (const int sample : mates)
      if (!same_bits(image.cube.at(sample), image.cube.at(mates[0]))) return false;
  }
  return true;
}

Planes3 world_positions(const GeometryImage& image) {
  const int n = image.size();
  Planes3 world(n);
  for (int row = 0; row < n; ++row)
    for (int col = 0; col < n; ++col)
      world.set(row, col, vec_cast<float>(image.world_position(row, col)));
  return world;
}

}  // namespace weft
