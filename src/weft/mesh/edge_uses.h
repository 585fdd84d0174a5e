#pragma once

#include <span>
#include <string>
#include <vector>

#include "weft/mesh.h"

namespace weft {

/// Every undirected edge of a mesh with its half-edges (3 t + k, as in weft/mesh/topology.h). The
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
