#include <algorithm>
#include <cmath>

#include "weft/core/math.h"
#include "weft/param/edge_lengths.h"
#include "weft/param/weights.h"

namespace weft {
namespace {

/// The one-ring of an interior vertex, flattened: neighbour l lies at the end of half_edge[l].
struct PolarRing {
  std::vector<int> half_edge;
  std::vector<double> angle;  ///< between neighbours l and l + 1 [rad]
  std::vector<Vec2d> point;   ///< the centre is the origin
};

/// Scales the angles to a full turn. None may reach half a turn, or the centre would not lie inside
/// the flattened ring: a spike with one or two wide triangles has their excess handed to the
/// others.
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

/// The neighbour r such that the ray from neighbour l through the centre leaves between r and r
/// + 1.
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
    // A ray that leaves exactly through a neighbour may round to a tiny negative area.
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

}  // namespace weft
