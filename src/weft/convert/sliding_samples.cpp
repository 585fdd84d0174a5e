#include "weft/convert/sliding_samples.h"

#include "weft/convert/sample.h"

namespace weft {
namespace {

TriangleMesh mesh_of(const DiskMesh& disk) {
  TriangleMesh mesh;
  mesh.positions = disk.positions;
  mesh.triangles = disk.triangles;
  return mesh;
}

/// Barycentric coordinates of a point of a triangle, a little off its edges: on an edge of the
/// chart lie border samples alone.
std::array<double, 3> weights_at(Vec3d at, const Corners& corners) {
  constexpr double off_edges = 1e-3;
  std::array<double, 3> weights{};
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    weights[k] = length(cross(corners[(k + 1) % 3] - at, corners[(k + 2) % 3] - at));
    sum += weights[k];
  }
  for (double& w : weights) w = (1 - off_edges) * (w / sum) + off_edges / 3;
  return weights;
}

/// Twice the area long.
Vec3d normal_of(const Corners& corners) {
  return cross(corners[1] - corners[0], corners[2] - corners[0]);
}

bool is_inside(Vec2d place, ChartSize size) {
  return place.x > 0 && place.y > 0 && place.x < size.cols - 1 && place.y < size.rows - 1;
}

}  // namespace

SlidingSurface::SlidingSurface(const MappedDisk& mapped)
    : disk_(mapped.cut.disk),
      map_(mapped.map),
      normals_(disk_vertex_normals(disk_)),
      query_(mesh_of(disk_)) {}

Corners SlidingSurface::corners(int triangle) const {
  const Triangle& t = disk_.triangles[triangle];
  return {disk_.positions[t[0]], disk_.positions[t[1]], disk_.positions[t[2]]};
}

SurfaceSample SlidingSurface::at(const Triangle& t, const std::array<double, 3>& weights) const {
  const auto blend = [&](const auto& values) {
    return weights[0] * values[t[0]] + weights[1] * values[t[1]] + weights[2] * values[t[2]];
  };
  return {blend(disk_.positions), normalized(blend(normals_)), blend(map_.uv)};
}

PlaneAt SlidingSurface::foot(Vec3d point) const {
  const ClosestPoint found = query_.closest(point);
  const Corners triangle = corners(found.triangle);
  const Vec3d way = point - found.position;
  // Of a point on the surface, the way is rounding alone.
  const bool is_off = length(way) > 1e-9 * (length(triangle[1] - triangle[0]) + length(point));
  return {found.position, normalized(is_off ? way : normal_of(triangle))};
}

std::optional<SurfaceSample> SlidingSurface::moved(const SurfaceSample& sample,
                                                   Vec3d displacement) const {
  const ClosestPoint found = query_.closest(sample.position + displacement);
  const Corners triangle = corners(found.triangle);
  if (!(dot(normal_of(triangle), sample.normal) > 0)) return std::nullopt;
  const SurfaceSample there =
      at(disk_.triangles[found.triangle], weights_at(found.position, triangle));
  if (!is_inside(there.place, map_.size)) return std::nullopt;
  return there;
}

}  // namespace weft
