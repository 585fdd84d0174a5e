#include "weft/param/weights.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "weft/core/math.h"

namespace weft {

std::vector<double> mean_value_weights(const DiskMesh& disk, const HalfEdges& edges,
                                       std::span<const std::array<double, 3>> sides) {
  std::vector<double> weights(3 * disk.triangles.size(), 0.0);
  for (int t = 0; t < static_cast<int>(disk.triangles.size()); ++t) {
    const std::array<double, 3> tangents = half_angle_tangents(sides[t]);
    for (int k = 0; k < 3; ++k) {
      // The angle at corner k lies beside the half-edge that leaves it and beside the twin of the
      // half-edge that arrives.
      weights[3 * t + k] += tangents[k] / sides[t][k];
      const int arriving = (k + 2) % 3;
      const int twin = edges.twin[3 * t + arriving];
      if (twin >= 0) weights[twin] += tangents[k] / sides[t][arriving];
    }
  }
  return weights;
}

std::vector<double> symmetric_weights(const DiskMesh& disk, const HalfEdges& edges,
                                      std::span<const std::array<double, 3>> sides) {
  std::vector<double> weights = mean_value_weights(disk, edges, sides);
  for (int h = 0; h < static_cast<int>(weights.size()); ++h) {
    const int twin = edges.twin[h];
    if (twin > h) weights[h] = weights[twin] = 0.5 * (weights[h] + weights[twin]);
  }
  return weights;
}

namespace {

/// The flattened one-ring of an interior vertex: neighbour l is the end of half_edge[l].
struct PolarRing {
  std::vector<int> half_edge;
  std::vector<double> angle;  ///< between neighbours l and l + 1 [rad]
  std::vector<Vec2d> point;   ///< the centre is the origin
};

/// Scales the angles to a sum of 2 pi. Each is kept below pi, or the centre would not lie inside
/// the flattened ring: at a spike with one or two wide triangles, the others get their excess.
void scale_to_full_turn(std::vector<double>& angles) {
  constexpr double widest = 0.95 * pi;
  double total = 0;
  for (const double a : angles) total += a;
  for (double& a : angles) a *= 2 * pi / total;
  for (int pass = 0; pass < 2; ++pass) {
    double capped = 0;
    double free = 0;
    for (double& a : angles) {
      a = std::min(a, widest);
      (a < widest ? free : capped) += a;
    }
    for (double& a : angles)
      if (a < widest) a *= (2 * pi - capped) / free;
  }
}

void flatten_ring(int vertex, const HalfEdges& edges, std::span<const std::array<double, 3>> sides,
                  PolarRing& ring) {
  ring.half_edge.clear();
  ring.angle.clear();
  ring.point.clear();
  const int first = edges.outgoing[vertex];
  for (int h = first;;) {
    ring.half_edge.push_back(h);
    ring.angle.push_back(2 * arc_tangent(half_angle_tangents(sides[h / 3])[h % 3], 1.0));
    h = edges.twin[HalfEdges::previous(h)];
    if (h == first) break;
  }
  scale_to_full_turn(ring.angle);
  double direction = 0;
  for (std::size_t l = 0; l < ring.half_edge.size(); ++l) {
    const int h = ring.half_edge[l];
    const double radius = sides[h / 3][h % 3];
    ring.point.push_back({radius * cosine(direction), radius * sine(direction)});
    direction += ring.angle[l];
  }
}

/// The neighbour r such that the ray from neighbour l through the centre crosses the side from r to
/// r + 1.
int opposite_side(const PolarRing& ring, int l) {
  const int count = static_cast<int>(ring.angle.size());
  double turned = 0;
  int r = l;
  for (int step = 0; step < count - 2; ++step) {
    turned += ring.angle[r];
    if (turned > pi) return r;
    r = (r + 1) % count;
  }
  return r;
}

/// Adds the barycentric coordinates of the centre in the triangle of neighbours l, r and r + 1.
void add_coordinates(const PolarRing& ring, int l, std::vector<double>& weights) {
  const int count = static_cast<int>(ring.angle.size());
  const int r = opposite_side(ring, l);
  const int s = (r + 1) % count;
  const std::array<int, 3> corner = {l, r, s};
  std::array<double, 3> area{};
  double total = 0;
  for (int k = 0; k < 3; ++k) {
    // The area may round to slightly below zero where the ray passes through a neighbour.
    area[k] =
        std::max(0.0, cross(ring.point[corner[(k + 1) % 3]], ring.point[corner[(k + 2) % 3]]));
    total += area[k];
  }
  for (int k = 0; k < 3; ++k) weights[ring.half_edge[corner[k]]] += area[k] / (total * count);
}

}  // namespace

std::vector<double> shape_preserving_weights(const DiskMesh& disk, const HalfEdges& edges,
                                             std::span<const std::array<double, 3>> sides) {
  std::vector<double> weights(3 * disk.triangles.size(), 0.0);
  std::vector<bool> border(disk.positions.size(), false);
  for (const int v : disk.border) border[v] = true;
  PolarRing ring;
  for (int v = 0; v < static_cast<int>(disk.positions.size()); ++v) {
    if (border[v] || edges.outgoing[v] < 0) continue;
    flatten_ring(v, edges, sides, ring);
    for (int l = 0; l < static_cast<int>(ring.half_edge.size()); ++l)
      add_coordinates(ring, l, weights);
  }
  return weights;
}

void reweight(const DiskGeometry& geometry, std::span<const Vec2d> uv, std::span<double> weights) {
  const std::vector<double> sigma = vertex_stretch(geometry.surface, geometry.disk.triangles, uv);
  for (int h = 0; h < static_cast<int>(weights.size()); ++h)
    weights[h] /= sigma[from_vertex(geometry.disk.triangles, h)] *
                  sigma[to_vertex(geometry.disk.triangles, h)];
}

bool map_by_reweighting(const DiskGeometry& geometry, InteriorSolver& solver,
                        std::vector<double>& weights, std::span<Vec2d> uv,
                        const ReweightingOptions& options) {
  std::vector<Vec2d> best;
  double best_stretch = std::numeric_limits<double>::infinity();
  int rounds_with_map = 0;
  for (int round = 0; rounds_with_map <= options.iterations; ++round) {
    if (best.empty() && round > options.cures) break;
    update(options.progress, "map", std::min(1.0, round / (options.iterations + 1.0)));
    if (!solver.factorize_symmetric(weights)) break;
    solver.solve_symmetric(uv);
    const double stretch = geometry.stretch_l2(uv);
    const bool enough = stretch > best_stretch * (1 - options.min_gain);
    if (stretch < best_stretch && is_valid_map(geometry.disk.triangles, uv)) {
      best_stretch = stretch;
      best.assign(uv.begin(), uv.end());
    }
    if (!best.empty()) ++rounds_with_map;
    if (enough) break;
    reweight(geometry, uv, weights);
  }
  if (best.empty()) return false;
  std::copy(best.begin(), best.end(), uv.begin());
  return true;
}

}  // namespace weft
