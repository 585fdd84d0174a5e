#pragma once

#include <vector>

#include "weft/mesh.h"
#include "weft/mesh/topology.h"

namespace weft {

/// A mesh with its half-edges and edge lengths: what every step of cutting reads. Keeps a reference
/// to the mesh, which must outlive it.
class CutSurface {
 public:
  /// @pre repaired mesh. @throws TopologyError as half_edges
  explicit CutSurface(const TriangleMesh& mesh);

  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  [[nodiscard]] int vertex_count() const { return static_cast<int>(mesh_.positions.size()); }
  [[nodiscard]] int triangle_count() const { return static_cast<int>(mesh_.triangles.size()); }
  [[nodiscard]] int half_edge_count() const { return 3 * triangle_count(); }
  [[nodiscard]] const HalfEdges& edges() const { return edges_; }
  [[nodiscard]] int twin(int half_edge) const { return edges_.twin[half_edge]; }
  [[nodiscard]] int from(int half_edge) const { return from_vertex(mesh_.triangles, half_edge); }
  [[nodiscard]] int to(int half_edge) const { return to_vertex(mesh_.triangles, half_edge); }
  [[nodiscard]] double length(int half_edge) const { return length_[half_edge]; }
  /// The end of the half-edge's edge that is not `vertex`.
  [[nodiscard]] int other_end(int half_edge, int vertex) const {
    return from(half_edge) == vertex ? to(half_edge) : from(half_edge);
  }
  /// One name for both half-edges of an edge: the smaller index.
  [[nodiscard]] int edge_name(int half_edge) const {
    const int other = twin(half_edge);
    return other >= 0 && other < half_edge ? other : half_edge;
  }

  /// Calls visit(half_edge) once for every edge at a vertex, in turning order: with the half-edge
  /// that leaves the vertex, or, for the one border edge that has none, with the one that arrives.
  template <class Visit>
  void for_each_edge(int vertex, const Visit& visit) const {
    const int start = edges_.outgoing[vertex];
    for (int h = start; h >= 0;) {
      visit(h);
      const int arriving = HalfEdges::previous(h);
      h = twin(arriving);
      if (h < 0) visit(arriving);
      if (h == start) return;
    }
  }

 private:
  const TriangleMesh& mesh_;
  HalfEdges edges_;
  std::vector<double> length_;  // [3F]
};

}  // namespace weft
