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

}  // namespace

EdgeUses edge_uses(int vertex_count, std::span<const Triangle> triangles) {
  const int count = 3 * static_cast<int>(triangles.size());
  // A counting sort by the lesser vertex leaves buckets of a handful for the comparison sort.
  std::vector<int> bucket(vertex_count + 1, 0);
  for (int h = 0; h < count; ++h) ++bucket[ends(triangles, h).first + 1];
  for (int v = 0; v < vertex_count; ++v) bucket[v + 1] += bucket[v];
  EdgeUses uses;
  uses.half_edges.resize(count);
  std::vector<int> fill(bucket.begin(), bucket.end() - 1);
  for (int h = 0; h < count; ++h) uses.half_edges[fill[ends(triangles, h).first]++] = h;
  for (int v = 0; v < vertex_count; ++v)
    std::sort(uses.half_edges.begin() + bucket[v], uses.half_edges.begin() + bucket[v + 1],
              [&](int a, int b) {
                return std::pair(ends(triangles, a).second, a) <
                       std::pair(ends(triangles, b).second, b);
              });
  for (int i = 0; i < count; ++i)
    if (i == 0 || ends(triangles, uses.half_edges[i]) != ends(triangles, uses.half_edges[i - 1]))
      uses.first.push_back(i);
  uses.first.push_back(count);
  return uses;
}

std::string edge_name(std::span<const Triangle> triangles, const EdgeUses& edges, int edge) {
  const auto [low, high] = ends(triangles, edges.of(edge)[0]);
  return fmt::format("vertices {} and {} (counted from 0)", low, high);
}

}  // namespace weft
