#include "weft/mesh/manifold.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "weft/core/disjoint_sets.h"
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
  /// The same, going on where an edge forbids it. @param parted  [E] such edges are set
  void decide_all(std::vector<bool>& parted) {
    parted_ = &parted;
    decide();
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
        if (edges_.of(edge).size() != 2 || orient(edge, queue_[i])) continue;
        if (parted_ == nullptr) return edge;
        (*parted_)[edge] = true;
      }
    return -1;
  }
  /// Decides on the triangle across the edge. @return false if it was decided otherwise before
  bool orient(int edge, int triangle) {
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
  std::vector<bool>* parted_ = nullptr;
};

int flip_turned(std::span<Triangle> triangles, const Orienter& orienter) {
  int count = 0;
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
    if (!orienter.turned(t)) continue;
    std::swap(triangles[t][1], triangles[t][2]);
    ++count;
  }
  return count;
}

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
  return flip_turned(triangles, orienter);
}

int orient_parts(std::span<Triangle> triangles, const EdgeUses& edges, std::vector<bool>& parted) {
  parted.assign(static_cast<std::size_t>(edges.edge_count()), false);
  Orienter orienter(triangles, edges);
  orienter.decide_all(parted);
  for (int e = 0; e < edges.edge_count(); ++e)
    if (edges.of(e).size() > 2) parted[e] = true;
  return flip_turned(triangles, orienter);
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

PartedVertices part_vertices(int vertex_count, std::span<Triangle> triangles, const EdgeUses& edges,
                             const std::vector<bool>& parted) {
  const int corners = 3 * static_cast<int>(triangles.size());
  DisjointSets fans(corners);
  for (int e = 0; e < edges.edge_count(); ++e) {
    const std::span<const int> along = edges.of(e);
    if (parted[e] || along.size() != 2) continue;
    fans.join(along[0], HalfEdges::next(along[1]));
    fans.join(HalfEdges::next(along[0]), along[1]);
  }
  PartedVertices result;
  result.source_vertex.resize(vertex_count);
  std::iota(result.source_vertex.begin(), result.source_vertex.end(), 0);
  std::vector<int> number(static_cast<std::size_t>(corners), -1);
  std::vector<bool> used(static_cast<std::size_t>(vertex_count), false);
  for (int corner = 0; corner < corners; ++corner) {
    int& vertex = number[fans.root(corner)];
    if (vertex >= 0) continue;
    const int source = from_vertex(triangles, corner);
    vertex = used[source] ? static_cast<int>(result.source_vertex.size()) : source;
    if (used[source]) result.source_vertex.push_back(source);
    used[source] = true;
  }
  DisjointSets joined(static_cast<int>(result.source_vertex.size()));
  const auto vertex_at = [&](int corner) { return number[fans.root(corner)]; };
  for (int e = 0; e < edges.edge_count(); ++e) {
    if (!parted[e]) continue;
    const int one = edges.of(e)[0];
    for (const int other : edges.of(e).subspan(1)) {
      const bool opposed = from_vertex(triangles, one) != from_vertex(triangles, other);
      const int ahead = HalfEdges::next(other);
      joined.join(vertex_at(one), vertex_at(opposed ? ahead : other));
      joined.join(vertex_at(HalfEdges::next(one)), vertex_at(opposed ? other : ahead));
    }
  }
  for (int v = 0; v < static_cast<int>(result.source_vertex.size()); ++v)
    result.joined.push_back(joined.root(v));
  for (int corner = 0; corner < corners; ++corner)
    triangles[corner / 3][corner % 3] = vertex_at(corner);
  return result;
}

namespace {

/// The vertices of a half-edge in the parted mesh, the lesser first.
std::array<int, 2> ends_of(std::span<const Triangle> triangles, int half_edge) {
  const int a = from_vertex(triangles, half_edge), b = to_vertex(triangles, half_edge);
  return {std::min(a, b), std::max(a, b)};
}

/// [E] whether two triangles still share a parted edge.
std::vector<bool> closed_slits(std::span<const Triangle> parted_triangles, const EdgeUses& edges,
                               const std::vector<bool>& parted) {
  std::vector<bool> closed(parted.size(), false);
  for (int e = 0; e < edges.edge_count(); ++e) {
    if (!parted[e]) continue;
    std::vector<std::array<int, 2>> ends;
    for (const int h : edges.of(e)) ends.push_back(ends_of(parted_triangles, h));
    std::sort(ends.begin(), ends.end());
    closed[e] = std::adjacent_find(ends.begin(), ends.end()) != ends.end();
  }
  return closed;
}

}  // namespace

void lengthen_slits(const TriangleMesh& mesh, const EdgeUses& edges, std::vector<bool>& parted) {
  for (;;) {
    std::vector<Triangle> triangles = mesh.triangles;
    part_vertices(static_cast<int>(mesh.positions.size()), triangles, edges, parted);
    const std::vector<bool> closed = closed_slits(triangles, edges, parted);
    // Of each vertex at the end of one, where it comes from, and the best way on found so far.
    struct WayOn {
      int from = -1, edge = -1;
      double straightness = -2;
    };
    std::unordered_map<int, WayOn> ways;
    for (int e = 0; e < edges.edge_count(); ++e)
      if (closed[e]) {
        const int h = edges.of(e)[0];
        ways[to_vertex(mesh.triangles, h)].from = from_vertex(mesh.triangles, h);
      }
    if (ways.empty()) return;
    for (int e = 0; e < edges.edge_count(); ++e) {
      if (parted[e] || edges.of(e).size() != 2) continue;
      const int h = edges.of(e)[0];
      const int a = from_vertex(mesh.triangles, h), b = to_vertex(mesh.triangles, h);
      for (const auto& [at, other] : {std::array{a, b}, std::array{b, a}}) {
        const auto found = ways.find(at);
        if (found == ways.end()) continue;
        const auto& p = mesh.positions;
        const double straightness =
            dot(normalized(p[at] - p[found->second.from]), normalized(p[other] - p[at]));
        if (straightness > found->second.straightness)
          found->second = {found->second.from, e, straightness};
      }
    }
    bool longer = false;
    for (const auto& [at, way] : ways) {
      if (way.edge < 0) continue;
      parted[way.edge] = true;
      longer = true;
    }
    if (!longer) return;
  }
}

}  // namespace weft
