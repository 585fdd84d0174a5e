#include "weft/param/disk_geometry.h"

#include <algorithm>

#include "weft/core/orientation.h"
#include "weft/param/curvature_weight.h"
#include "weft/param/edge_queue.h"
#include "weft/param/triangle_energy.h"

namespace weft {

DiskGeometry::DiskGeometry(const DiskMesh& mesh)
    : disk(mesh),
      edges(half_edges(static_cast<int>(mesh.positions.size()), mesh.triangles)),
      sides(floored_lengths(mesh.positions, mesh.triangles)),
      surface(surface_triangles(mesh.positions, mesh.triangles)),
      curvature_weight(curvature_weights(mesh, edges, surface)) {
  for (const SurfaceTriangle& s : surface) inverse.push_back(inverse_weight(s));
}

double DiskGeometry::mean_square_stretch(std::span<const Vec2d> uv) const {
  double plane = 0;
  double area = 0;
  for (std::size_t t = 0; t < surface.size(); ++t) {
    const auto& [a, b, c] = disk.triangles[t];
    plane += 0.5 * cross(uv[b] - uv[a], uv[c] - uv[a]);
    area += surface[t].area;
  }
  return area / plane;
}

double DiskGeometry::energy(std::span<const Vec2d> uv) const {
  const double unit = mean_square_stretch(uv);
  const double inverse_unit = unit * unit;
  double sum = 0;
  for (std::size_t t = 0; t < surface.size(); ++t) {
    if (surface[t].area <= 0) continue;
    const auto& [a, b, c] = disk.triangles[t];
    const double m = triangle_stretch(surface[t], uv[a], uv[b], uv[c]).mean_square;
    sum += surface[t].area * m * (1 + 0.5 * curvature_weight[t] * m / unit);
    const double d = cross(uv[b] - uv[a], uv[c] - uv[a]);
    // n = 2 m d^2, see inverse_weight.
    sum += inverse_unit * inverse[t] * 2 * m * d * d;
  }
  return sum;
}

double DiskGeometry::stretch_l2(std::span<const Vec2d> uv) const {
  return measure_stretch(surface, disk.triangles, uv).l2;
}

bool is_valid_map(std::span<const Triangle> triangles, std::span<const Vec2d> uv) {
  return std::all_of(triangles.begin(), triangles.end(), [&](const Triangle& t) {
    return orientation(uv[t[0]], uv[t[1]], uv[t[2]]) > 0;
  });
}

}  // namespace weft
