#include "weft/mesh/manifold.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/mesh/topology.h"

namespace weft {

namespace {

/// Whether the two half-edges of an edge have the same direction, before any triangle is flipped.
bool same_direction(std::span<const Triangle> triangles, std::span<const int> uses) {
  return from_vertex(triangles, uses[0]) == from_vertex(triangles, uses[1]);
}

/// Breadth-first walk over the triangles that decides which to flip.
class Orienter {
 public:
  Orienter(std::span<const Triangle> triangles, const EdgeUses& edges)
      : triangles_(triangles),
        edges_(edges),
        edge_of_(3 * triangles.size()),
        turned_(triangles.size(), unknown) {
    for (int e = 0; e < edges.edge_count(); ++e)
      for (const int h : edges.of(e)) edge_of_[h] = e;
  }

  /// Decides for each triangle whether to flip it. @return an edge where that is impossible, or -1
  int decide() {
    for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) {
      if (turned_[t] != unknown) continue;
      const int edge = walk_from(t);
      if (edge >= 0) return edge;
      keep_majority();
    }
    return -1;
  }
  [[nodiscard]] bool turned(int triangle) const { return turned_[triangle] == yes; }

 private:
  static constexpr signed char unknown = -1, no = 0, yes = 1;

  int walk_from(int seed) {
    queue_.assign(1, seed);
    turned_[seed] = no;
    for (std::size_t i = 0; i < queue_.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const int edge = edge_of_[3 * queue_[i] + k];
        if (edges_.of(edge).size() == 2 && !settle(edge, queue_[i])) return edge;
      }
    return -1;
  }
  /// Decides on the triangle across the edge. @return false if it was decided otherwise before
  bool settle(int edge, int triangle) {
    const std::span<const int> uses = edges_.of(edge);
    const int other = uses[0] / 3 == triangle ? uses[1] / 3 : uses[0] / 3;
    const bool differs = same_direction(triangles_, uses);
    const signed char wanted = (turned_[triangle] == yes) != differs ? yes : no;
    if (turned_[other] != unknown) return turned_[other] == wanted;
    turned_[other] = wanted;
    queue_.push_back(other);
    return true;
  }
  void keep_majority() {
    const auto count =
        std::count_if(queue_.begin(), queue_.end(), [&](int t) { return turned(t); });
    if (2 * static_cast<std::size_t>(count) <= queue_.size()) return;
    for (const int t : queue_) turned_[t] = turned(t) ? no : yes;
  }

  std::span<const Triangle> triangles_;
  const EdgeUses& edges_;
  std::vector<int> edge_of_;
  std::vector<signed char> turned_;
  std::vector<int> queue_;
};

}  // namespace

int orient_triangles(std::span<Triangle> triangles, const EdgeUses& edges,
                     std::string_view mesh_name) {
  Orienter orienter(triangles, edges);
  const int edge = orienter.decide();
  if (edge >= 0)
    throw TopologyError(mesh_name,
                        fmt::format("the surface is not orientable, as seen at the edge between {}",
                                    edge_name(triangles, edges, edge)),
                        "an orientable surface is wanted");
  int count = 0;
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
    if (!orienter.turned(t)) continue;
    std::swap(triangles[t][1], triangles[t][2]);
    ++count;
  }
  return count;
}

namespace {

/// All half-edges that leave the vertex of `start` inside its fan.
void walk_fan(const HalfEdges& edges, int start, std::vector<int>& fan) {
  fan.clear();
  int h = start;
  do {
    fan.push_back(h);
    h = edges.twin[HalfEdges::previous(h)];
  } while (h >= 0 && h != start);
  if (h == start) return;
  for (h = edges.twin[start]; h >= 0; h = edges.twin[h]) {
    h = HalfEdges::next(h);
    fan.push_back(h);
  }
}

}  // namespace

VertexSplit split_fans(int vertex_count, std::span<Triangle> triangles) {
  const HalfEdges edges = half_edges(vertex_count, triangles);
  VertexSplit split;
  split.source_vertex.resize(vertex_count);
  std::iota(split.source_vertex.begin(), split.source_vertex.end(), 0);
  std::vector<int> fans_at(vertex_count, 0), fan;
  std::vector<bool> seen(edges.twin.size(), false);
  for (int h = 0; h < static_cast<int>(edges.twin.size()); ++h) {
    if (seen[h]) continue;
    const int vertex = from_vertex(triangles, h);
    const int fans = ++fans_at[vertex];
    if (fans == 2) ++split.split_vertices;
    if (fans > 1) split.fans += fans == 2 ? 2 : 1;
    if (fans > 1) split.source_vertex.push_back(vertex);
    walk_fan(edges, h, fan);
    for (const int corner : fan) {
      seen[corner] = true;
      if (fans > 1)
        triangles[corner / 3][corner % 3] = static_cast<int>(split.source_vertex.size()) - 1;
    }
  }
  return split;
}

}  // namespace weft
