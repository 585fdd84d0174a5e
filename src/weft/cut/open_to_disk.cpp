#include "weft/cut/open_to_disk.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "weft/cut/cut_graph.h"
#include "weft/cut/cut_surface.h"
#include "weft/cut/straighten.h"
#include "weft/error.h"

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

/// A further seed shortens the cut by a few percent at best, so large meshes, where it is slow, get
/// fewer.
constexpr int max_seeds = 4;
constexpr int triangles_for_all_seeds = 80000;

int seed_count(int triangles) {
  return std::clamp(triangles_for_all_seeds / triangles, 1, max_seeds);
}

Cut open_sphere(const CutSurface& surface, int seed_triangle) {
  CutGraph graph(surface);
  for (const int h : far_path(surface, surface.mesh().triangles[seed_triangle][0])) graph.add(h);
  return graph.cut();
}

CutGraph open_from(const CutGraph& held, int seed_triangle, bool straightened) {
  CutGraph graph = cut_from_seed(held, seed_triangle);
  if (straightened) straighten(graph);
  return graph;
}

/// The shortest of the cuts from a few seeds; the first of equal ones.
Cut shortest_cut(const CutGraph& held, bool straightened) {
  const CutSurface& surface = held.surface();
  std::optional<Cut> best;
  double best_length = 0;
  for (const int seed : spread_triangles(surface, 0, seed_count(surface.triangle_count()))) {
    const CutGraph graph = open_from(held, seed, straightened);
    const double length = graph.length();
    if (best && length >= best_length) continue;
    best = graph.cut();
    best_length = length;
  }
  return *best;
}

void check_seed(int seed_triangle, int triangles) {
  if (seed_triangle < -1 || seed_triangle >= triangles)
    throw TopologyError("seed triangle", fmt::format("{}", seed_triangle),
                        fmt::format("0 to {}, or -1 to choose", triangles - 1));
}

}  // namespace

Cut complete_cut(const CutGraph& held, const CutOptions& options) {
  check_seed(options.seed_triangle, held.surface().triangle_count());
  if (options.seed_triangle < 0) return shortest_cut(held, options.straighten);
  return open_from(held, options.seed_triangle, options.straighten).cut();
}

Cut open_to_disk(const TriangleMesh& mesh, const CutOptions& options) {
  return open_to_disk(CutSurface(mesh), options);
}

Cut open_to_disk(const CutSurface& surface, const CutOptions& options) {
  check_seed(options.seed_triangle, surface.triangle_count());
  const TopologyCounts counts = count_topology(surface.mesh().triangles, surface.edges());
  if (counts.genus == 0 && counts.boundaries == 1) return {};
  if (counts.genus == 0 && counts.boundaries == 0)
    return open_sphere(surface, options.seed_triangle < 0 ? 0 : options.seed_triangle);
  return complete_cut(CutGraph(surface), options);
}

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
