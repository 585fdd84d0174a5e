#include "weft/mesh/shapes/handles.h"

#include <algorithm>
#include <cmath>

#include "weft/mesh/shapes/field.h"
#include "weft/mesh/shapes/polygonise.h"
#include "weft/mesh/shapes/remesh.h"

namespace weft {
namespace {

constexpr double edge = 0.018;  // [m]

double wanted_edge(Vec3d /*place*/) { return edge; }

/// @param half  half the extent of the shape, whose centre is the origin
TriangleMesh mesh_of(double (*field)(Vec3d), Vec3d half) {
  const Vec3d margin{edge, edge, edge};
  Box3d box;
  box.add(half + margin);
  box.add(-(half + margin));
  return remesh(polygonise(field, box, edge),
                {.surface = field, .cut = {}, .edge_length = wanted_edge});
}

// Struts of the plate are as wide as it is thick, so that each is a round rod.
constexpr double strut = 0.06, hole = 0.05, pitch = 2 * hole + strut;
constexpr double half_cols = 2, half_rows = 1.5;  // holes from the middle one to the last
constexpr double border = hole + strut;           // from the centre of an outer hole to the edge

/// Distance in the plane of the plate from its outline with holes, negative on it.
double outline(double x, double z) {
  const double right = std::abs(x), up = std::abs(z);
  const double to_col = right - std::min(half_cols, std::round(right / pitch)) * pitch;
  const double to_row = up - (std::min(1.0, std::floor(up / pitch)) + 0.5) * pitch;
  const double from_hole = hole - std::sqrt(to_col * to_col + to_row * to_row);
  const double beyond_x = std::max(0.0, right - half_cols * pitch);
  const double beyond_z = std::max(0.0, up - half_rows * pitch);
  const double from_edge = std::sqrt(beyond_x * beyond_x + beyond_z * beyond_z) - border;
  return std::max(from_hole, from_edge);
}

}  // namespace

double double_torus_field(Vec3d point) {
  constexpr double major = 0.18, minor = 0.075, apart = 0.215, blend = 0.06;
  const auto ring = [&](double centre) {
    const double x = point.x - centre;
    const double from_line = std::sqrt(x * x + point.z * point.z) - major;
    return std::sqrt(from_line * from_line + point.y * point.y) - minor;
  };
  return smooth_min(ring(-apart), ring(apart), blend);
}

double genus20_field(Vec3d point) {
  constexpr double radius = 0.5 * strut;
  const double beyond = std::max(0.0, outline(point.x, point.z) + radius);
  return std::sqrt(beyond * beyond + point.y * point.y) - radius;
}

TriangleMesh double_torus_mesh() { return mesh_of(double_torus_field, {0.47, 0.09, 0.26}); }

TriangleMesh genus20_mesh() {
  return mesh_of(genus20_field,
                 {half_cols * pitch + border, 0.5 * strut, half_rows * pitch + border});
}

}  // namespace weft
