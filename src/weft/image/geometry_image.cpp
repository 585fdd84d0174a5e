#include "weft/geometry_image.h"

#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/image/image_colours.h"

namespace weft {
namespace {

bool same_bits(Vec3f a, Vec3f b) {
  const auto same = [](float p, float q) {
    return std::bit_cast<std::uint32_t>(p) == std::bit_cast<std::uint32_t>(q);
  };
  return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z);
}

bool in_unit_cube(const Planes3& cube) {
  const int n = cube.size();
  for (const Grid<float>* plane : {&cube.x, &cube.y, &cube.z}) {
    if (plane->rows() != n || plane->cols() != n) return false;
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c)
        if (!((*plane)(r, c) >= 0 && (*plane)(r, c) <= 1)) return false;
  }
  return true;
}

bool has_size(const WorldMap& world) {
  const Vec3d p = world.lower;
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) &&
         std::isfinite(world.scale) && world.scale > 0;
}

}  // namespace

void check_image(const GeometryImage& image, std::string_view name) {
  const int n = image.size();
  if (n < min_image_size || n > largest_image_size)
    throw InputError(name, fmt::format("a geometry image of side {}", n),
                     fmt::format("a side of {} .. {}", min_image_size, largest_image_size));
  if (!in_unit_cube(image.cube))
    throw InputError(name, "samples outside the unit cube, or not n x n",
                     "three planes of values in [0, 1] are wanted");
  if (!has_size(image.world))
    throw InputError(name, "a world that is not finite or has no size", "a scale > 0 is wanted");
  if (image.mates.size() != 0 && image.mates.size() != n)
    throw InputError(name, fmt::format("border mates of side {}", image.mates.size()),
                     fmt::format("mates of side {}", n));
  if (!mates_bit_equal(image))
    throw InputError(name, "border mates with different positions",
                     "mates that hold equal bits are wanted");
  check_colours(image, name);
}

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
