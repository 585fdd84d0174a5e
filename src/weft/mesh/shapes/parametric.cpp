#include "weft/mesh/shapes/parametric.h"

#include <cmath>

#include "weft/core/math.h"
#include "weft/mesh/shapes/patch.h"

namespace weft {
Vec3d sheet_point(double u, double v) { return {u - 0.5, 0, v - 0.5}; }

Vec3d disk_point(double u, double v) {
  const double x = 2 * u - 1, z = 2 * v - 1;
  if (x == 0 && z == 0) return {};
  // The ring is fixed by the larger coordinate, the angle on it by the ratio of the two.
  const bool along_x = std::abs(x) > std::abs(z);
  const double ring = 0.5 * (along_x ? x : z);
  const double angle = 0.25 * pi * (along_x ? z / x : x / z);
  const double near = ring * cosine(angle), far = ring * sine(angle);
  return along_x ? Vec3d{near, 0, far} : Vec3d{far, 0, near};
}

Vec3d torus_point(double u, double v) {
  const double around = 2 * pi * u, tube = 2 * pi * v;
  const double radius = torus_major_radius + torus_minor_radius * cosine(tube);
  return {radius * cosine(around), torus_minor_radius * sine(tube), -radius * sine(around)};
}

Vec3d cylinder_point(double u, double v) {
  const double around = 2 * pi * u;
  return {cylinder_radius * cosine(around), cylinder_height * (v - 0.5),
          -cylinder_radius * sine(around)};
}

TriangleMesh sheet_mesh() { return patch_mesh({.cols = 64, .rows = 64}, sheet_point); }
TriangleMesh disk_mesh() { return patch_mesh({.cols = 64, .rows = 64}, disk_point); }
TriangleMesh torus_mesh() {
  return patch_mesh({.cols = 96, .rows = 40, .wraps_u = true, .wraps_v = true}, torus_point);
}
TriangleMesh cylinder_mesh() {
  return patch_mesh({.cols = 80, .rows = 64, .wraps_u = true}, cylinder_point);
}

}  // namespace weft
