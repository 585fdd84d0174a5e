#include "weft/mesh/topology.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "weft/core/assert.h"
#include "weft/core/disjoint_sets.h"
#include "weft/error.h"
#include "weft/mesh/edge_uses.h"

namespace weft {
namespace {

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
  counts.genus = -1;
  return counts;
}

}  // namespace weft
