#include "weft/convert/patch_deviation.h"

#include <algorithm>
#include <cmath>

#include "weft/mesh/distance.h"

namespace weft {
namespace {

struct Squares {
  double largest = 0, sum = 0;
  int count = 0;
  void add(double squared) {
    largest = std::max(largest, squared);
    sum += squared;
    ++count;
  }
  [[nodiscard]] double mean() const { return count > 0 ? sum / count : 0; }
};

ClosestPointQuery query_of(std::span<const Corners> triangles) {
  TriangleMesh mesh;
  for (const Corners& corners : triangles) {
    const int first = static_cast<int>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return ClosestPointQuery(mesh);
}

double spacing_of(std::span<const Corners> triangles) {
  double twice_area = 0;
  for (const auto& [a, b, c] : triangles) twice_area += length(cross(b - a, c - a));
  return std::sqrt(twice_area / static_cast<double>(triangles.size()));
}

}  // namespace

PatchDeviation PatchDeviation::of(std::span<const Corners> triangles,
                                  std::span<const SurfaceSample> on_surface,
                                  const SlidingSurface& surface) {
  const ClosestPointQuery query = query_of(triangles);
  Squares from_triangles, from_surface;
  for (const SurfaceSample& sample : on_surface)
    from_triangles.add(query.closest(sample.position).squared_distance);
  for (const auto& [a, b, c] : triangles) {
    const Vec3d middle = (1.0 / 3) * (a + b + c), way = middle - surface.foot(middle).position;
    from_surface.add(dot(way, way));
  }
  const double spacing = spacing_of(triangles);
  return {std::sqrt(std::max(from_triangles.largest, from_surface.largest)) / spacing,
          std::sqrt(from_triangles.mean() + from_surface.mean()) / spacing};
}

}  // namespace weft
