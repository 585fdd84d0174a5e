#include "weft/mesh/edge_uses.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "weft/mesh/topology.h"

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

}  // namespace

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
