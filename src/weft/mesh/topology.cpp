#include "weft/mesh/topology.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "weft/core/assert.h"
#include "weft/core/disjoint_sets.h"
#include "weft/error.h"

namespace weft {
namespace {

std::pair<int, int> ends(std::span<const Triangle> triangles, int half_edge) {
  return std::minmax(from_vertex(triangles, half_edge), to_vertex(triangles, half_edge));
}

/// A half-edge in the bundle of all edges that share their smaller vertex.
struct Use {
  int high = 0;  ///< the larger vertex
  int half_edge = 0;
};

/// Sorts by larger vertex, then half-edge; by insertion where that is faster: for few uses.
void sort_bundle(std::span<Use> uses) {
  constexpr std::size_t few = 24;
  const auto before = [](const Use& a, const Use& b) {
    return a.high != b.high ? a.high < b.high : a.half_edge < b.half_edge;
  };
  if (uses.size() > few) {
    std::sort(uses.begin(), uses.end(), before);
    return;
  }
  for (std::size_t i = 1; i < uses.size(); ++i) {
    const Use use = uses[i];
    std::size_t place = i;
    for (; place > 0 && before(use, uses[place - 1]); --place) uses[place] = uses[place - 1];
    uses[place] = use;
  }
}

/// The next border half-edge after one: rotates about the vertex that it points at, inside one fan,
/// so that borders that only touch at a vertex stay separate.
int next_on_border(const HalfEdges& edges, int half_edge) {
  int h = HalfEdges::next(half_edge);
  while (edges.twin[h] >= 0) h = HalfEdges::next(edges.twin[h]);
  return h;
}

void check_edge(std::span<const Triangle> triangles, std::span<const int> uses) {
  const int a = from_vertex(triangles, uses[0]);
  const int b = to_vertex(triangles, uses[0]);
  if (a == b)
    throw TopologyError("", fmt::format("triangle {} has vertex {} twice", uses[0] / 3, a),
                        "three different vertices are wanted");
  if (uses.size() > 2)
    throw TopologyError("", fmt::format("edge {}-{} has {} triangles", a, b, uses.size()),
                        "at most two are wanted");
  if (uses.size() == 2 && from_vertex(triangles, uses[1]) == a)
    throw TopologyError(
        "", fmt::format("two triangles run along edge {}-{} in the same direction", a, b),
        "a consistent orientation is wanted");
}

/// Number of components of vertices connected by triangles, without unreferenced vertices.
int count_components(std::span<const Triangle> triangles, const HalfEdges& edges) {
  std::vector<int> parent(edges.outgoing.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const Triangle& t : triangles) {
    parent[root(t[1])] = root(t[0]);
    parent[root(t[2])] = root(t[0]);
  }
  int count = 0;
  for (int v = 0; v < static_cast<int>(parent.size()); ++v)
    count += edges.outgoing[v] >= 0 && root(v) == v ? 1 : 0;
  return count;
}

}  // namespace

HalfEdges half_edges(int vertex_count, std::span<const Triangle> triangles) {
  WEFT_ASSERT(std::all_of(triangles.begin(), triangles.end(), [&](const Triangle& t) {
    return std::min({t[0], t[1], t[2]}) >= 0 && std::max({t[0], t[1], t[2]}) < vertex_count;
  }));
  const EdgeUses uses = edge_uses(vertex_count, triangles);
  HalfEdges edges;
  edges.twin.assign(3 * triangles.size(), -1);
  for (int e = 0; e < uses.edge_count(); ++e) {
    const std::span<const int> along = uses.of(e);
    check_edge(triangles, along);
    if (along.size() < 2) continue;
    edges.twin[along[0]] = along[1];
    edges.twin[along[1]] = along[0];
  }
  edges.outgoing.assign(vertex_count, -1);
  int h = 0;
  for (const Triangle& t : triangles)
    for (const int v : t) {
      int& out = edges.outgoing[v];
      if (out < 0 || (edges.twin[h] < 0 && edges.twin[out] >= 0)) out = h;
      ++h;
    }
  return edges;
}

std::vector<std::vector<int>> border_loops(std::span<const Triangle> triangles,
                                           const HalfEdges& edges) {
  std::vector<std::vector<int>> loops;
  std::vector<bool> seen(edges.twin.size(), false);
  for (int start = 0; start < static_cast<int>(edges.twin.size()); ++start) {
    if (edges.twin[start] >= 0 || seen[start]) continue;
    std::vector<int>& loop = loops.emplace_back();
    for (int h = start; !seen[h]; h = next_on_border(edges, h)) {
      seen[h] = true;
      loop.push_back(from_vertex(triangles, h));
    }
  }
  return loops;
}

TopologyCounts count_topology(int vertex_count, std::span<const Triangle> triangles) {
  return count_topology(triangles, half_edges(vertex_count, triangles));
}

TopologyCounts count_topology(std::span<const Triangle> triangles, const HalfEdges& edges) {
  TopologyCounts counts;
  for (const int h : edges.outgoing) counts.vertices += h >= 0 ? 1 : 0;
  for (int h = 0; h < static_cast<int>(edges.twin.size()); ++h)
    counts.edges += edges.twin[h] < h ? 1 : 0;
  counts.triangles = static_cast<int>(triangles.size());
  counts.components = count_components(triangles, edges);
  counts.boundaries = static_cast<int>(border_loops(triangles, edges).size());
  counts.euler = counts.vertices - counts.edges + counts.triangles;
  counts.genus = (2 * counts.components - counts.boundaries - counts.euler) / 2;
  return counts;
}

namespace {

/// Whether edges have at most two triangles, which run along them in opposite directions, and
/// vertices one fan of them.
bool is_oriented_manifold(int vertex_count, std::span<const Triangle> triangles,
                          const EdgeUses& edges) {
  const int corners = 3 * static_cast<int>(triangles.size());
  DisjointSets fans(corners);
  for (int e = 0; e < edges.edge_count(); ++e) {
    const std::span<const int> along = edges.of(e);
    if (along.size() < 2) continue;
    if (along.size() > 2 || from_vertex(triangles, along[0]) == from_vertex(triangles, along[1]))
      return false;
    fans.join(along[0], HalfEdges::next(along[1]));
    fans.join(HalfEdges::next(along[0]), along[1]);
  }
  std::vector<char> seen(static_cast<std::size_t>(vertex_count), 0);
  for (int corner = 0; corner < corners; ++corner)
    if (fans.root(corner) == corner &&
        std::exchange(seen[from_vertex(triangles, corner)], char{1}) != 0)
      return false;
  return true;
}

}  // namespace

TopologyCounts count_complex(int vertex_count, std::span<const Triangle> triangles) {
  const EdgeUses edges = edge_uses(vertex_count, triangles);
  TopologyCounts counts;
  DisjointSets parts(vertex_count), borders(vertex_count);
  std::vector<char> used(static_cast<std::size_t>(vertex_count), 0);
  constexpr char in_triangle = 1, on_border = 2;
  for (const Triangle& t : triangles)
    for (const int v : t) used[v] = in_triangle;
  for (int e = 0; e < edges.edge_count(); ++e) {
    const int h = edges.of(e)[0];
    const int a = from_vertex(triangles, h), b = to_vertex(triangles, h);
    parts.join(a, b);
    if (edges.of(e).size() > 1) continue;
    borders.join(a, b);
    used[a] = used[b] = on_border;
  }
  for (int v = 0; v < vertex_count; ++v) {
    counts.vertices += used[v] != 0 ? 1 : 0;
    counts.components += used[v] != 0 && parts.root(v) == v ? 1 : 0;
    counts.boundaries += used[v] == on_border && borders.root(v) == v ? 1 : 0;
  }
  counts.edges = edges.edge_count();
  counts.triangles = static_cast<int>(triangles.size());
  counts.euler = counts.vertices - counts.edges + counts.triangles;
  counts.genus = is_oriented_manifold(vertex_count, triangles, edges)
                     ? (2 * counts.components - counts.boundaries - counts.euler) / 2
                     : -1;
  return counts;
}

EdgeUses edge_uses(int vertex_count, std::span<const Triangle> triangles) {
  const int count = 3 * static_cast<int>(triangles.size());
  // A counting sort by the smaller vertex leaves small buckets for the comparison sort.
  std::vector<int> bucket(vertex_count + 1, 0);
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) ++bucket[std::min(t[k], t[(k + 1) % 3]) + 1];
  for (int v = 0; v < vertex_count; ++v) bucket[v + 1] += bucket[v];
  std::vector<Use> sorted(count);
  std::vector<int> fill(bucket.begin(), bucket.end() - 1);
  int half_edge = 0;
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
      sorted[fill[low]++] = {high, half_edge++};
    }
  EdgeUses uses;
  uses.half_edges.reserve(count);
  uses.first.reserve(count / 2 + 1);
  for (int v = 0; v < vertex_count; ++v) {
    const std::span<Use> bundle(sorted.data() + bucket[v], sorted.data() + bucket[v + 1]);
    sort_bundle(bundle);
    for (std::size_t i = 0; i < bundle.size(); ++i) {
      if (i == 0 || bundle[i].high != bundle[i - 1].high)
        uses.first.push_back(static_cast<int>(uses.half_edges.size()));
      uses.half_edges.push_back(bundle[i].half_edge);
    }
  }
  uses.first.push_back(count);
  return uses;
}

std::string edge_name(std::span<const Triangle> triangles, const EdgeUses& edges, int edge) {
  const auto [low, high] = ends(triangles, edges.of(edge)[0]);
  return fmt::format("vertices {} and {} (counted from 0)", low, high);
}

std::vector<int> one_ring(std::span<const Triangle> triangles, std::span<const int> around,
                          int vertex) {
  std::vector<int> found;
  for (const int t : around)
    for (const int v : triangles[t])
      if (v != vertex) found.push_back(v);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace weft
