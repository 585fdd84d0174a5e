#pragma once

#include <functional>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "weft/mesh.h"
#include "weft/mesh/topology.h"

namespace weft {

/// A mesh with its half-edges and edge lengths: the input of every step of cutting. Keeps a
/// reference to the mesh, which must outlive it.
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
  /// The end of the half-edge other than `vertex`.
  [[nodiscard]] int other_end(int half_edge, int vertex) const {
    return from(half_edge) == vertex ? to(half_edge) : from(half_edge);
  }
  /// Index of an edge, the same for both its half-edges: the smaller of the two.
  [[nodiscard]] int edge_name(int half_edge) const {
    const int other = twin(half_edge);
    return other >= 0 && other < half_edge ? other : half_edge;
  }

  /// Calls visit(half_edge) once for every edge at a vertex, counter-clockwise: with the half-edge
  /// that leaves the vertex, or, for the one border edge without such a half-edge, with the one
  /// that arrives.
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

/// A length and a vertex or half-edge, ordered by length, then index, so that ties are resolved the
/// same way every time.
using Reach = std::pair<double, int>;
/// Priority queue with the shortest length on top.
using ReachQueue = std::priority_queue<Reach, std::vector<Reach>, std::greater<>>;

/// Shortest paths along edges from a set of vertices.
struct PathTree {
  std::vector<double> distance;  ///< [V] [m], HUGE_VAL where not reached
  std::vector<int> arrival;  ///< [V] a half-edge of the last edge on the path to a vertex, or -1
  int end = -1;  ///< the vertex at which the search stopped; -1: no vertex met the condition
};

/// Dijkstra's search along edges; ends at the first settled vertex for which stop(vertex) holds.
template <class Stop>
PathTree search_paths(const CutSurface& surface, std::span<const int> sources, const Stop& stop) {
  PathTree tree;
  tree.distance.assign(surface.vertex_count(), HUGE_VAL);
  tree.arrival.assign(surface.vertex_count(), -1);
  ReachQueue queue;
  for (const int v : sources) {
    tree.distance[v] = 0;
    queue.emplace(0.0, v);
  }
  while (!queue.empty()) {
    const auto [distance, v] = queue.top();
    queue.pop();
    if (distance > tree.distance[v]) continue;
    if (stop(v)) {
      tree.end = v;
      return tree;
    }
    surface.for_each_edge(v, [&, here = distance, from = v](int h) {
      const int w = surface.other_end(h, from);
      const double there = here + surface.length(h);
      if (there >= tree.distance[w]) return;
      tree.distance[w] = there;
      tree.arrival[w] = h;
      queue.emplace(there, w);
    });
  }
  return tree;
}

/// Shortest paths to all vertices.
PathTree paths_from(const CutSurface& surface, std::span<const int> sources);

/// The half-edges of the tree's path to `vertex`, from there back to a source. Each edge is given
/// by either of its half-edges.
std::vector<int> path_to(const CutSurface& surface, const PathTree& tree, int vertex);

/// The shortest path between two vertices far apart, an approximate diameter: the search goes from
/// `start` to the farthest vertex and repeats from there as long as the distance grows.
std::vector<int> far_path(const CutSurface& surface, int start);

}  // namespace weft
