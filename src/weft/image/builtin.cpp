#include "weft/image/builtin.h"

#include <array>
#include <string>
#include <vector>

#include "weft/core/assert.h"
#include "weft/error.h"
#include "weft/mesh/shapes/parametric.h"

namespace weft {
namespace {

/// A shape as a map of the square, with its box: `lower` corner and largest side.
struct ImageShape {
  std::string_view name;
  Vec3d (*point)(double u, double v);
  WorldMap world;
  bool wraps_u, wraps_v;  ///< left mates right, bottom mates top
};

constexpr std::array image_shapes{
    ImageShape{"sheet", sheet_point, {{-0.5, 0, -0.5}, 1}, false, false},
    ImageShape{"disk", disk_point, {{-0.5, 0, -0.5}, 1}, false, false},
    ImageShape{"torus", torus_point, {{-0.5, -torus_minor_radius, -0.5}, 1}, true, true},
    ImageShape{"cylinder",
               cylinder_point,
               {{-cylinder_radius, -0.5 * cylinder_height, -cylinder_radius}, cylinder_height},
               true,
               false},
};

const ImageShape& find_shape(std::string_view name) {
  std::string names;
  for (const ImageShape& shape : image_shapes) {
    if (shape.name == name) return shape;
    names.append(names.empty() ? "" : ", ").append(shape.name);
  }
  throw UsageError("builtin:" + std::string(name), "not a shape that is an image by nature",
                   "one of " + names + " is wanted");
}

std::vector<MateInterval> mate_intervals(const ImageShape& shape, int size) {
  const int side = size - 1;
  std::vector<MateInterval> intervals;
  if (shape.wraps_v) intervals.push_back({.first = 0, .mate = 3 * side, .count = side});
  if (shape.wraps_u) intervals.push_back({.first = side, .mate = 0, .count = side});
  return intervals;
}

/// Rounding may carry a point of the box a little beyond the cube.
float into_cube(double value) { return static_cast<float>(value < 0 ? 0 : value > 1 ? 1 : value); }

}  // namespace

GeometryImage make_image_shape(std::string_view name, int size) {
  WEFT_ASSERT(size >= min_image_size);
  const ImageShape& shape = find_shape(name);
  GeometryImage image;
  image.cube = Planes3(size);
  image.world = shape.world;
  image.source = "builtin:" + std::string(name);
  image.mates = BorderMates(size, mate_intervals(shape, size));
  const int period = size - 1;
  for (int r = 0; r < size; ++r)
    for (int c = 0; c < size; ++c) {
      // A wrapping shape comes back to the very same sample, so that mates hold the same bits.
      const int row = shape.wraps_v ? r % period : r, col = shape.wraps_u ? c % period : c;
      const Vec3d p = (1 / shape.world.scale) * (shape.point(static_cast<double>(col) / period,
                                                             static_cast<double>(row) / period) -
                                                 shape.world.lower);
      image.cube.set(r, c, {into_cube(p.x), into_cube(p.y), into_cube(p.z)});
    }
  return image;
}

}  // namespace weft
