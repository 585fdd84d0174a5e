#pragma once

#include <functional>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "weft/cut/cut_surface.h"

namespace weft {

/// A length and a vertex or half-edge: ordered by length, then index, so that ties have one
/// outcome.
using Reach = std::pair<double, int>;
/// The nearest reach on top.
using ReachQueue = std::priority_queue<Reach, std::vector<Reach>, std::greater<>>;

/// Shortest paths along edges from a set of vertices.
struct PathTree {
  std::vector<double> distance;  ///< [V] [m], HUGE_VAL where not reached
  std::vector<int> arrival;  ///< [V] a half-edge of the edge that a vertex was reached by, or -1
  int end = -1;              ///< the vertex at which the search stopped, -1: it ran over all
};

/// Dijkstra's search; ends at the first settled vertex for which stop(vertex) holds.
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

/// The half-edges of the tree's path that ends at `vertex`, from there back to a source; either
/// half-edge of an edge may stand for it.
std::vector<int> path_to(const CutSurface& surface, const PathTree& tree, int vertex);

/// The shortest path between two vertices that are far apart: from `start` to the farthest vertex,
/// from there to its farthest, as long as the distance grows.
std::vector<int> far_path(const CutSurface& surface, int start);

}  // namespace weft
