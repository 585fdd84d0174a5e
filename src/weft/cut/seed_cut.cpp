#include "weft/cut/seed_cut.h"

#include <algorithm>

#include "weft/cut/cut_surface.h"

namespace weft {
namespace {

/// Closes the edges that the tree of removed triangles crosses.
class TriangleRemoval {
 public:
  TriangleRemoval(CutGraph& graph, std::vector<double> distance)
      : graph_(graph),
        surface_(graph.surface()),
        distance_(std::move(distance)),
        removed_(surface_.triangle_count(), 0) {}

  void run(int seed_triangle) {
    remove_triangle(seed_triangle);
    while (!queue_.empty()) {
      const int h = queue_.top().second;
      queue_.pop();
      const int across = surface_.twin(h) / 3;
      if (removed_[across] || graph_.is_held(h)) continue;
      graph_.remove(h);
      remove_triangle(across);
    }
  }

 private:
  void remove_triangle(int triangle) {
    removed_[triangle] = 1;
    for (int h = 3 * triangle; h < 3 * triangle + 3; ++h)
      if (surface_.twin(h) >= 0 && !removed_[surface_.twin(h) / 3])
        queue_.emplace(0.5 * (distance_[surface_.from(h)] + distance_[surface_.to(h)]), h);
  }

  CutGraph& graph_;
  const CutSurface& surface_;
  std::vector<double> distance_;
  std::vector<char> removed_;
  ReachQueue queue_;
};

}  // namespace

CutGraph cut_from_seed(const CutGraph& held, int seed_triangle) {
  const CutSurface& surface = held.surface();
  CutGraph graph = held;
  graph.hold();
  graph.add_all();
  const Triangle& corners = surface.mesh().triangles[seed_triangle];
  TriangleRemoval(graph, paths_from(surface, corners).distance).run(seed_triangle);
  graph.prune();
  return graph;
}

std::vector<int> spread_triangles(const CutSurface& surface, int first, int count) {
  std::vector<int> triangles{first};
  std::vector<int> sources(surface.mesh().triangles[first].begin(),
                           surface.mesh().triangles[first].end());
  while (static_cast<int>(triangles.size()) < count) {
    const std::vector<double> distance = paths_from(surface, sources).distance;
    const auto far = std::max_element(distance.begin(), distance.end());
    if (*far <= 0) break;
    const int vertex = static_cast<int>(far - distance.begin());
    triangles.push_back(HalfEdges::triangle_of(surface.edges().outgoing[vertex]));
    sources.push_back(vertex);
  }
  return triangles;
}

}  // namespace weft
