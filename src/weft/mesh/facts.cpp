#include "weft/mesh/facts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

namespace weft {
namespace {

constexpr double sliver_quality = 0.01;

// One side of a triangle, its ends sorted; `forward` when the triangle runs from a to b.
struct Side {
  int a = 0, b = 0, triangle = 0;
  bool forward = true;
};

std::vector<Side> sorted_sides(const std::vector<Triangle>& triangles) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t)
    for (int k = 0; k < 3; ++k) {
      const int from = triangles[t][k], to = triangles[t][(k + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), t, from < to});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& l, const Side& r) {
    return std::array{l.a, l.b, l.triangle} < std::array{r.a, r.b, r.triangle};
  });
  return sides;
}

// Disjoint sets with the parity of an element against its root: tells whether triangles can all be
// turned so that neighbours agree.
class ParitySets {
 public:
  explicit ParitySets(int count) : parent_(count), parity_(count, 0) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int root(int i, int& parity) const {
    parity = 0;
    for (; parent_[i] != i; i = parent_[i]) parity ^= parity_[i];
    return i;
  }
  /// Joins i and j with the given relative parity; false when they are joined already with the
  /// other one.
  bool join(int i, int j, int parity) {
    int pi = 0, pj = 0;
    const int ri = root(i, pi), rj = root(j, pj);
    if (ri == rj) return (pi ^ pj) == parity;
    const auto [low, high] = std::minmax(ri, rj);
    parent_[high] = low;
    parity_[high] = pi ^ pj ^ parity;
    return true;
  }
  [[nodiscard]] int count() const {
    int roots = 0;
    for (int i = 0; i < static_cast<int>(parent_.size()); ++i) roots += parent_[i] == i ? 1 : 0;
    return roots;
  }

 private:
  std::vector<int> parent_, parity_;
};

void examine_edges(const std::vector<Side>& sides, MeshFacts& facts) {
  ParitySets sets(facts.triangles);
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
    while (last < sides.size() && sides[last].a == sides[first].a &&
           sides[last].b == sides[first].b)
      ++last;
    const std::span edge_sides = std::span(sides).subspan(first, last - first);
    const std::size_t count = edge_sides.size();
    const Side& one = edge_sides.front();
    if (count == 1) ++facts.border_edges;
    if (count > 2) {
      ++facts.nonmanifold_edges;
      facts.nonmanifold_edge_list.push_back({one.a, one.b});
    }
    const bool agree = count != 2 || one.forward != edge_sides.back().forward;
    if (!agree) ++facts.inconsistent_edges;
    for (const Side& other : edge_sides.subspan(1))
      if (!sets.join(one.triangle, other.triangle, agree ? 0 : 1) && count == 2)
        facts.orientable = false;
  }
  facts.components = sets.count();
}

// A vertex is manifold when its triangles, joined over the sides that they share at it, are one
// set.
void examine_vertices(const TriangleMesh& mesh, const std::vector<Side>& sides, MeshFacts& facts) {
  std::vector<int> fans(mesh.positions.size(), 0);
  ParitySets corners(3 * facts.triangles);
  const auto corner = [&](int triangle, int vertex) {
    const Triangle& t = mesh.triangles[triangle];
    return 3 * triangle + static_cast<int>(std::find(t.begin(), t.end(), vertex) - t.begin());
  };
  for (std::size_t k = 1; k < sides.size(); ++k) {
    const Side &l = sides[k - 1], &r = sides[k];
    if (l.a != r.a || l.b != r.b) continue;
    corners.join(corner(l.triangle, l.a), corner(r.triangle, l.a), 0);
    corners.join(corner(l.triangle, l.b), corner(r.triangle, l.b), 0);
  }
  for (int c = 0, parity = 0; c < 3 * facts.triangles; ++c)
    if (corners.root(c, parity) == c) ++fans[mesh.triangles[c / 3][c % 3]];
  for (int v = 0; v < static_cast<int>(fans.size()); ++v)
    if (fans[v] > 1) facts.nonmanifold_vertex_list.push_back(v);
  facts.nonmanifold_vertices = static_cast<int>(facts.nonmanifold_vertex_list.size());
}

}  // namespace

double triangle_quality(Vec3d a, Vec3d b, Vec3d c) {
  const double edges = squared_length(b - a) + squared_length(c - b) + squared_length(a - c);
  return edges > 0 ? 2 * std::sqrt(3.0) * length(cross(b - a, c - a)) / edges : 0;
}

MeshFacts examine_mesh(const TriangleMesh& mesh) {
  MeshFacts facts;
  facts.vertices = static_cast<int>(mesh.positions.size());
  facts.triangles = static_cast<int>(mesh.triangles.size());
  const std::vector<Side> sides = sorted_sides(mesh.triangles);
  examine_edges(sides, facts);
  examine_vertices(mesh, sides, facts);
  for (const auto& [a, b, c] : mesh.triangles) {
    const double quality =
        triangle_quality(mesh.positions[a], mesh.positions[b], mesh.positions[c]);
    facts.slivers += quality < sliver_quality ? 1 : 0;
    facts.least_quality = std::min(facts.least_quality, quality);
  }
  return facts;
}

}  // namespace weft
