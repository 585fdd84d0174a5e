#include "weft/param/disk_geometry.h"

#include <algorithm>
#include <cmath>

#include "weft/core/orientation.h"
#include "weft/param/triangle_energy.h"

namespace weft {
namespace {

/// How much the two shorter sides together exceed the longest.
double slack(const std::array<double, 3>& s) {
  return std::min({s[0] + s[1] - s[2], s[1] + s[2] - s[0], s[2] + s[0] - s[1]});
}

/// A density on the surface: its integral over each triangle, and the area of integration.
struct Density {
  std::vector<double> sum, area;
};

/// Square curvature: a dihedral angle at an edge of length l is taken for a cylinder that bends by
/// this angle over the width of the two triangles.
Density square_curvature(const DiskMesh& disk, const HalfEdges& edges,
                         std::span<const SurfaceTriangle> surface) {
  const std::vector<Vec3d>& p = disk.positions;
  std::vector<Vec3d> normals;
  Density density{std::vector<double>(surface.size(), 0.0), {}};
  for (std::size_t t = 0; t < surface.size(); ++t) {
    const auto& [a, b, c] = disk.triangles[t];
    normals.push_back(normalized(cross(p[b] - p[a], p[c] - p[a])));
    density.area.push_back(surface[t].area);
  }
  for (int h = 0; h < static_cast<int>(edges.twin.size()); ++h) {
    const int twin = edges.twin[h];
    if (twin < 0) continue;
    const double area = surface[h / 3].area + surface[twin / 3].area;
    if (!(area > 0)) continue;
    const Vec3d edge = p[to_vertex(disk.triangles, h)] - p[from_vertex(disk.triangles, h)];
    const double square_angle = squared_length(normals[h / 3] - normals[twin / 3]);
    density.sum[h / 3] += square_angle * squared_length(edge) / area;
  }
  return density;
}

/// Smooths: adds the integrals and areas of its neighbours to every triangle.
void spread(Density& density, const HalfEdges& edges) {
  const Density before = density;
  for (int h = 0; h < static_cast<int>(edges.twin.size()); ++h) {
    if (edges.twin[h] < 0) continue;
    density.sum[h / 3] += before.sum[edges.twin[h] / 3];
    density.area[h / 3] += before.area[edges.twin[h] / 3];
  }
}

double total(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum;
}

}  // namespace

std::vector<std::array<double, 3>> floored_lengths(std::span<const Vec3d> positions,
                                                   std::span<const Triangle> triangles) {
  std::vector<std::array<double, 3>> sides(triangles.size());
  double total = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      sides[t][k] = length(positions[triangles[t][(k + 1) % 3]] - positions[triangles[t][k]]);
      total += sides[t][k];
    }
  const double mean =
      total / (3.0 * static_cast<double>(std::max<std::size_t>(triangles.size(), 1)));
  const double min_slack = mean > 0 ? 1e-5 * mean : 1.0;

  double raise = 0;
  for (const auto& s : sides) raise = std::max(raise, min_slack - slack(s));
  if (raise > 0)
    for (auto& s : sides)
      for (double& l : s) l += raise;
  return sides;
}

std::array<double, 3> half_angle_tangents(const std::array<double, 3>& sides) {
  // tan(A / 2) = r / (s - a) with the inradius r; the differences s - a are computed without the
  // cancellation of subtracting from the half perimeter s.
  const std::array<double, 3> rest = {0.5 * (sides[0] + sides[2] - sides[1]),
                                      0.5 * (sides[0] + sides[1] - sides[2]),
                                      0.5 * (sides[1] + sides[2] - sides[0])};
  const double half_perimeter = rest[0] + rest[1] + rest[2];
  const double inradius = std::sqrt(rest[0] * (rest[1] * rest[2] / half_perimeter));
  return {inradius / rest[0], inradius / rest[1], inradius / rest[2]};
}

std::vector<double> curvature_weights(const DiskMesh& disk, const HalfEdges& edges,
                                      std::span<const SurfaceTriangle> surface) {
  constexpr double everywhere = 0.1;
  constexpr double by_curvature = 0.2;
  constexpr double max = 20;
  constexpr int rounds = 4;
  Density density = square_curvature(disk, edges, surface);
  const double whole = total(density.sum);
  const double area = total(density.area);
  std::vector<double> curvature_weight(surface.size(), everywhere);
  // A flat surface has only rounding errors for curvature.
  if (!(whole > 1e-12)) return curvature_weight;
  for (int round = 0; round < rounds; ++round) spread(density, edges);
  for (std::size_t t = 0; t < curvature_weight.size(); ++t) {
    if (!(density.area[t] > 0)) continue;
    const double relative = density.sum[t] / density.area[t] * (area / whole);
    curvature_weight[t] += by_curvature * std::min(relative, max);
  }
  return curvature_weight;
}

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
