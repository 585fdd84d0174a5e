#include "weft/mesh/stretch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace weft {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

std::vector<SurfaceTriangle> surface_triangles(std::span<const Vec3d> positions,
                                               std::span<const Triangle> triangles) {
  std::vector<SurfaceTriangle> result;
  result.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) {
    const Vec3d p = positions[b] - positions[a];
    const Vec3d q = positions[c] - positions[a];
    result.push_back({dot(p, p), dot(p, q), dot(q, q), 0.5 * length(cross(p, q))});
  }
  return result;
}

TriangleStretch triangle_stretch(const SurfaceTriangle& surface, Vec2d a, Vec2d b, Vec2d c) {
  const Vec2d p = b - a;
  const Vec2d q = c - a;
  const double twice_area = cross(p, q);
  if (!(twice_area > 0)) return {infinity, infinity};
  // The trace of J^T J where J takes p, q to the edges in space; its determinant is (area /
  // area)^2.
  const double trace =
      (surface.g11 * dot(q, q) - 2 * surface.g12 * dot(p, q) + surface.g22 * dot(p, p)) /
      twice_area / twice_area;
  const double determinant = 2 * surface.area / twice_area;
  const double half = 0.5 * trace;
  const double root = std::sqrt(std::max(0.0, (half - determinant) * (half + determinant)));
  return {std::sqrt(half + root), half};
}

Stretch measure_stretch(std::span<const SurfaceTriangle> surface,
                        std::span<const Triangle> triangles, std::span<const Vec2d> uv) {
  double square_sum = 0;
  double surface_area = 0;
  double plane_area = 0;
  double largest = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    plane_area += 0.5 * cross(uv[b] - uv[a], uv[c] - uv[a]);
    if (surface[t].area <= 0) continue;
    const TriangleStretch stretch = triangle_stretch(surface[t], uv[a], uv[b], uv[c]);
    square_sum += surface[t].area * stretch.mean_square;
    surface_area += surface[t].area;
    largest = std::max(largest, stretch.largest);
  }
  if (surface_area <= 0) return {};
  const double scale = std::sqrt(plane_area / surface_area);
  return {std::sqrt(square_sum / surface_area) * scale, largest * scale};
}

std::vector<double> vertex_stretch(std::span<const SurfaceTriangle> surface,
                                   std::span<const Triangle> triangles, std::span<const Vec2d> uv) {
  constexpr double max = 1e4;
  double surface_area = 0;
  double plane_area = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    surface_area += surface[t].area;
    plane_area += 0.5 * cross(uv[b] - uv[a], uv[c] - uv[a]);
  }
  std::vector<double> square(uv.size(), 0.0);
  std::vector<double> area(uv.size(), 0.0);
  // In units of the stretch of a map that keeps areas.
  const double unit = plane_area > 0 && surface_area > 0 ? plane_area / surface_area : 1.0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    const double s = triangle_stretch(surface[t], uv[a], uv[b], uv[c]).mean_square * unit;
    const double bounded = std::clamp(s, 1 / (max * max), max * max);
    for (const int v : triangles[t]) {
      square[v] += surface[t].area * bounded;
      area[v] += surface[t].area;
    }
  }
  std::vector<double> sigma(uv.size(), 1.0);
  for (std::size_t v = 0; v < uv.size(); ++v)
    if (area[v] > 0) sigma[v] = std::sqrt(square[v] / area[v]);
  return sigma;
}

}  // namespace weft
