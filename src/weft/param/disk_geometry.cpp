#include "weft/param/disk_geometry.h"

#include <algorithm>

#include "weft/core/orientation.h"
#include "weft/param/edge_lengths.h"

namespace weft {

DiskGeometry::DiskGeometry(const DiskMesh& mesh)
    : disk(mesh),
      edges(half_edges(static_cast<int>(mesh.positions.size()), mesh.triangles)),
      sides(floored_lengths(mesh.positions, mesh.triangles)),
      surface(surface_triangles(mesh.positions, mesh.triangles)) {}

double DiskGeometry::stretch_l2(std::span<const Vec2d> uv) const {
  return measure_stretch(surface, disk.triangles, uv).l2;
}

bool is_valid_map(std::span<const Triangle> triangles, std::span<const Vec2d> uv) {
  return std::all_of(triangles.begin(), triangles.end(), [&](const Triangle& t) {
    return orientation(uv[t[0]], uv[t[1]], uv[t[2]]) > 0;
  });
}

}  // namespace weft
