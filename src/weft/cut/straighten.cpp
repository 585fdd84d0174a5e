#include "weft/cut/straighten.h"

#include <algorithm>

#include "weft/cut/cut_surface.h"

namespace weft {
namespace {

constexpr int max_rounds = 16;

double path_length(const CutSurface& surface, std::span<const int> path) {
  double total = 0;
  for (const int h : path) total += surface.length(h);
  return total;
}

/// Finds the shortest path between two borders of the surface opened along a graph, an annulus.
class AnnulusSearch {
 public:
  explicit AnnulusSearch(const CutGraph& graph)
      : graph_(graph),
        surface_(graph.surface()),
        side_(surface_.half_edge_count(), 0),
        distance_(surface_.vertex_count(), HUGE_VAL),
        arrival_(surface_.vertex_count(), -1) {}

  /// The half-edges of the shortest path between the border through `start` and the border through
  /// `end`, both open half-edges; empty when these are one border.
  std::vector<int> shortest(int start, int end) {
    std::vector<int> leaving = mark(start, 1);
    std::vector<int> path;
    if (side_[end] == 0) {
      std::vector<int> arriving = mark(end, 2);
      // The search spreads from one whole border, so the smaller one is cheaper.
      if (arriving.size() < leaving.size()) {
        path = search(arriving, 1);
        clear(arriving);
      } else {
        path = search(leaving, 2);
        clear(arriving);
      }
    }
    clear(leaving);
    return path;
  }

 private:
  /// Marks the border's half-edges and those that leave its vertices into the surface.
  std::vector<int> mark(int start, char side) {
    std::vector<int> marked;
    int h = start;
    do {
      marked.push_back(h);
      for (h = HalfEdges::next(h); !graph_.contains(h); h = HalfEdges::next(surface_.twin(h)))
        marked.push_back(h);
    } while (h != start);
    for (const int g : marked) side_[g] = side;
    return marked;
  }

  void clear(std::span<const int> marked) {
    for (const int h : marked) side_[h] = 0;
  }

  /// Dijkstra's search from the half-edges `leaving` over vertices off the open edges, to the
  /// border marked `goal`.
  std::vector<int> search(std::span<const int> leaving, char goal) {
    best_ = HUGE_VAL;
    best_last_ = -1;
    for (const int h : leaving)
      if (!graph_.contains(h)) reach(h, 0, goal);
    while (!queue_.empty() && queue_.top().first < best_) {
      const auto [here, v] = queue_.top();
      queue_.pop();
      if (here > distance_[v]) continue;
      surface_.for_each_edge(v, [&, from_here = here](int h) { reach(h, from_here, goal); });
    }
    queue_ = {};
    std::vector<int> path = trace();
    for (const int v : touched_) {
      distance_[v] = HUGE_VAL;
      arrival_[v] = -1;
    }
    touched_.clear();
    return path;
  }

  void reach(int h, double here, char goal) {
    const int w = surface_.to(h);
    const double there = here + surface_.length(h);
    if (graph_.valence(w) > 0) {
      if (side_[surface_.twin(h)] != goal || there >= best_) return;
      best_ = there;
      best_last_ = h;
    } else if (there < distance_[w]) {
      if (arrival_[w] < 0) touched_.push_back(w);
      distance_[w] = there;
      arrival_[w] = h;
      queue_.emplace(there, w);
    }
  }

  [[nodiscard]] std::vector<int> trace() const {
    std::vector<int> path;
    for (int h = best_last_; h >= 0;) {
      path.push_back(h);
      const int v = surface_.from(h);
      h = graph_.valence(v) > 0 ? -1 : arrival_[v];
    }
    return path;
  }

  const CutGraph& graph_;
  const CutSurface& surface_;
  std::vector<char> side_;  // [3F] border (1 or 2) that a half-edge leaves or follows; 0: none
  std::vector<double> distance_;
  std::vector<int> arrival_, touched_;
  ReachQueue queue_;
  double best_ = HUGE_VAL;
  int best_last_ = -1;
};

/// Shortens paths one after the other. A path that could not be shortened is skipped until another
/// path has changed.
class Straightener {
 public:
  explicit Straightener(CutGraph& graph)
      : graph_(graph), search_(graph), tried_at_(graph.surface().half_edge_count(), -1) {}

  /// Replaces the path through an open edge by a shorter one. @return the length gained [m]
  double shorten(int half_edge) {
    const CutSurface& surface = graph_.surface();
    // Nothing has changed since the last search here.
    if (tried_at_[surface.edge_name(half_edge)] == changes_) return 0;
    const std::vector<int> path = graph_.path_through(half_edge);
    for (const int h : path) graph_.remove(h);
    const int start = graph_.first_open(path.front());
    const int end = graph_.first_open(surface.twin(path.back()));
    const std::vector<int> shorter =
        start >= 0 && end >= 0 ? search_.shortest(start, end) : std::vector<int>{};
    const double gain = path_length(surface, path) - path_length(surface, shorter);
    const bool better = !shorter.empty() && gain > 0;
    if (better) ++changes_;
    for (const int h : better ? shorter : path) {
      graph_.add(h);
      tried_at_[surface.edge_name(h)] = changes_;
    }
    return better ? gain : 0;
  }

 private:
  CutGraph& graph_;
  AnnulusSearch search_;
  std::vector<int> tried_at_;  // [3F] by edge name: changes_ at the last search, -1: none
  int changes_ = 0;
};

/// The middle edge of every path that is not held, longest path first.
std::vector<int> representatives(const CutGraph& graph) {
  std::vector<Reach> ranked;
  for (const std::vector<int>& path : graph.paths())
    if (!graph.is_held(path.front()))
      ranked.emplace_back(-path_length(graph.surface(), path), path[path.size() / 2]);
  std::sort(ranked.begin(), ranked.end());
  std::vector<int> edges;
  edges.reserve(ranked.size());
  for (const auto& [_, h] : ranked) edges.push_back(h);
  return edges;
}

}  // namespace

void straighten(CutGraph& graph, double min_gain) {
  Straightener straightener(graph);
  for (int round = 0; round < max_rounds; ++round) {
    double gain = 0;
    for (const int h : representatives(graph))
      if (graph.contains(h)) gain += straightener.shorten(h);
    if (gain <= min_gain * graph.length()) return;
  }
}

}  // namespace weft
