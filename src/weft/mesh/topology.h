#pragma once

#include <span>
#include <string>
#include <vector>

#include "weft/mesh.h"
#include "weft/mesh_statistics.h"

namespace weft {

/// The half-edge view of a manifold, consistently oriented mesh. Half-edge 3 t + k runs from corner
/// k of triangle t to its next corner.
struct HalfEdges {
  /// [3F] the opposite half-edge, -1 on the border
  std::vector<int> twin;
  /// [V] one half-edge that leaves the vertex, -1 if none; at the border the one without a twin, so
  /// that rotating from it visits all triangles of the vertex
  std::vector<int> outgoing;

  static int triangle_of(int half_edge) { return half_edge / 3; }
  static int next(int half_edge) { return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1; }
  static int previous(int half_edge) { return half_edge % 3 == 0 ? half_edge + 2 : half_edge - 1; }
};

inline bool repeats_a_vertex(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// The vertex that a half-edge leaves.
inline int from_vertex(std::span<const Triangle> triangles, int half_edge) {
  return triangles[half_edge / 3][half_edge % 3];
}
/// The vertex that a half-edge points at.
inline int to_vertex(std::span<const Triangle> triangles, int half_edge) {
  return from_vertex(triangles, HalfEdges::next(half_edge));
}

/// @throws TopologyError naming the vertices of an edge that has more than two triangles, or
///         two that run along it in the same direction; or a triangle with a repeated vertex
/// @pre indices in [0, vertex_count)
HalfEdges half_edges(int vertex_count, std::span<const Triangle> triangles);

/// Every border loop as its vertices, each loop in the direction of its triangles' half-edges (the
/// surface lies to the left); loops ordered by their smallest half-edge, beginning there.
std::vector<std::vector<int>> border_loops(std::span<const Triangle> triangles,
                                           const HalfEdges& edges);

/// As count_topology (weft/mesh_statistics.h), from existing half-edges.
TopologyCounts count_topology(std::span<const Triangle> triangles, const HalfEdges& edges);

/// Every undirected edge of a mesh with its half-edges. The
/// mesh need be neither manifold nor oriented.
struct EdgeUses {
  std::vector<int> half_edges;  ///< [3F] edge after edge, ascending inside one edge
  std::vector<int> first;       ///< [E+1] where each edge begins in half_edges

  [[nodiscard]] int edge_count() const { return static_cast<int>(first.size()) - 1; }
  [[nodiscard]] std::span<const int> of(int edge) const {
    return std::span(half_edges).subspan(first[edge], first[edge + 1] - first[edge]);
  }
};

/// The edges of a mesh in ascending order of their smaller, then their larger vertex.
/// @pre indices in [0, vertex_count)
EdgeUses edge_uses(int vertex_count, std::span<const Triangle> triangles);

/// An edge as errors name it: "vertices 3 and 7 (counted from 0)".
std::string edge_name(std::span<const Triangle> triangles, const EdgeUses& edges, int edge);

/// The other vertices of the triangles around a vertex, ascending, each once.
/// @param triangles  all triangles
/// @param around     indices of those that have the vertex for a corner, in any order
std::vector<int> one_ring(std::span<const Triangle> triangles, std::span<const int> around,
                          int vertex);

}  // namespace weft
