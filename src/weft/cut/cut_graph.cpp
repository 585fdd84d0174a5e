#include "weft/cut/cut_graph.h"

#include <algorithm>

#include <fmt/format.h>

#include "weft/error.h"

namespace weft {
namespace {

int find_edge(const CutSurface& surface, int a, int b) {
  int found = -1;
  if (a >= 0 && a < surface.vertex_count())
    surface.for_each_edge(a, [&](int h) {
      if (surface.other_end(h, a) == b) found = h;
    });
  if (found < 0)
    throw TopologyError("cut", fmt::format("vertices {} and {} share no edge", a, b),
                        "a cut along edges of the mesh is wanted");
  return found;
}

}  // namespace

CutGraph::CutGraph(const CutSurface& surface)
    : surface_(surface), open_(surface.half_edge_count(), 0), ends_(surface.vertex_count()) {
  for (int h = 0; h < surface.half_edge_count(); ++h) {
    if (surface.twin(h) >= 0) continue;
    open_[h] = 1;
    count(h, 1);
  }
  hold();
}

void CutGraph::count(int half_edge, int change) {
  for (const int v : {surface_.from(half_edge), surface_.to(half_edge)}) {
    ends_[v].valence += change;
    ends_[v].mix ^= surface_.edge_name(half_edge);
  }
}

CutGraph::CutGraph(const CutSurface& surface, const Cut& cut) : CutGraph(surface) {
  for (const auto& [a, b] : cut.edges) add(find_edge(surface, a, b));
}

void CutGraph::set(int half_edge, bool open) {
  const int twin = surface_.twin(half_edge);
  if (twin < 0 || contains(half_edge) == open || is_held(half_edge)) return;
  open_[half_edge] = open_[twin] = open ? 1 : 0;
  count(half_edge, open ? 1 : -1);
}

void CutGraph::add_all() {
  for (int h = 0; h < surface_.half_edge_count(); ++h) add(h);
}

void CutGraph::prune() {
  for (int v = 0; v < surface_.vertex_count(); ++v) {
    for (int leaf = v; leaf >= 0 && valence(leaf) == 1;) {
      const int edge = ends_[leaf].mix;
      if (is_held(edge)) break;
      remove(edge);
      leaf = surface_.other_end(edge, leaf);
    }
  }
}

int CutGraph::first_open(int half_edge) const {
  int h = half_edge;
  while (!contains(h)) {
    h = HalfEdges::next(surface_.twin(h));
    if (h == half_edge) return -1;
  }
  return h;
}

void CutGraph::extend(std::vector<int>& path) const {
  const int start = surface_.from(path.front());
  for (;;) {
    const int last = path.back();
    const int end = surface_.to(last);
    if (valence(end) != 2 || end == start) return;
    int onward = -1;
    surface_.for_each_edge(end, [&](int h) {
      if (contains(h) && h != surface_.twin(last)) onward = h;
    });
    if (held_[onward] != held_[last]) return;
    path.push_back(onward);
  }
}

std::vector<int> CutGraph::path_through(int half_edge) const {
  std::vector<int> path{surface_.twin(half_edge)};
  extend(path);
  // Reversed, the path ends with the given half-edge and can be extended at its other end.
  std::reverse(path.begin(), path.end());
  for (int& h : path) h = surface_.twin(h);
  if (surface_.to(path.back()) != surface_.from(path.front())) extend(path);
  return path;
}

std::vector<std::vector<int>> CutGraph::paths() const {
  std::vector<char> seen(open_.size(), 0);
  std::vector<std::vector<int>> all;
  for (int h = 0; h < surface_.half_edge_count(); ++h) {
    if (!contains(h) || surface_.twin(h) < 0 || seen[h]) continue;
    all.push_back(path_through(h));
    for (const int g : all.back()) seen[g] = seen[surface_.twin(g)] = 1;
  }
  return all;
}

int CutGraph::piece_count() const {
  std::vector<char> seen(surface_.triangle_count(), 0);
  std::vector<int> stack;
  int pieces = 0;
  for (int t = 0; t < surface_.triangle_count(); ++t) {
    if (seen[t]) continue;
    ++pieces;
    seen[t] = 1;
    stack.push_back(t);
    while (!stack.empty()) {
      const int first = 3 * stack.back();
      stack.pop_back();
      for (int h = first; h < first + 3; ++h) {
        if (contains(h) || seen[surface_.twin(h) / 3]) continue;
        seen[surface_.twin(h) / 3] = 1;
        stack.push_back(surface_.twin(h) / 3);
      }
    }
  }
  return pieces;
}

double CutGraph::length() const {
  double total = 0;
  for (int h = 0; h < surface_.half_edge_count(); ++h)
    if (contains(h) && h < surface_.twin(h)) total += surface_.length(h);
  return total;
}

Cut CutGraph::cut() const {
  Cut cut;
  for (int h = 0; h < surface_.half_edge_count(); ++h)
    if (contains(h) && h < surface_.twin(h))
      cut.edges.push_back(
          {std::min(surface_.from(h), surface_.to(h)), std::max(surface_.from(h), surface_.to(h))});
  std::sort(cut.edges.begin(), cut.edges.end());
  return cut;
}

}  // namespace weft
