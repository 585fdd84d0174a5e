#include "weft/mesh/split_fans.h"

#include <numeric>

#include "weft/mesh/topology.h"

namespace weft {
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
