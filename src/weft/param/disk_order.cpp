#include "weft/param/disk_order.h"

#include "weft/mesh/topology.h"

namespace weft {
namespace {

/// The triangles in the order of a breadth-first walk.
std::vector<int> walk(const DiskMesh& disk) {
  const HalfEdges edges = half_edges(static_cast<int>(disk.positions.size()), disk.triangles);
  std::vector<char> seen(disk.triangles.size(), 0);
  std::vector<int> order{HalfEdges::triangle_of(edges.outgoing[disk.border[0]])};
  order.reserve(disk.triangles.size());
  seen[order[0]] = 1;
  for (std::size_t done = 0; done < order.size(); ++done)
    for (int h = 3 * order[done]; h < 3 * order[done] + 3; ++h) {
      if (edges.twin[h] < 0) continue;
      const int across = HalfEdges::triangle_of(edges.twin[h]);
      if (seen[across]) continue;
      seen[across] = 1;
      order.push_back(across);
    }
  return order;
}

/// The vertices as the triangles come to them, then those without triangles.
std::vector<int> vertices_along(const DiskMesh& disk, std::span<const int> triangles) {
  std::vector<char> seen(disk.positions.size(), 0);
  std::vector<int> order;
  order.reserve(disk.positions.size());
  const auto add = [&](int v) {
    if (!seen[v]) order.push_back(v);
    seen[v] = 1;
  };
  for (const int t : triangles)
    for (const int v : disk.triangles[t]) add(v);
  for (int v = 0; v < static_cast<int>(seen.size()); ++v) add(v);
  return order;
}

}  // namespace

OrderedDisk breadth_first(const DiskMesh& disk) {
  const std::vector<int> triangles = walk(disk);
  OrderedDisk ordered{{}, vertices_along(disk, triangles)};
  std::vector<int> number(ordered.vertex.size());
  for (const int v : ordered.vertex) {
    number[v] = static_cast<int>(ordered.disk.positions.size());
    ordered.disk.positions.push_back(disk.positions[v]);
    ordered.disk.surface_vertex.push_back(disk.surface_vertex[v]);
  }
  ordered.disk.triangles.reserve(triangles.size());
  for (const int t : triangles) {
    const auto& [a, b, c] = disk.triangles[t];
    ordered.disk.triangles.push_back({number[a], number[b], number[c]});
  }
  for (const int v : disk.border) ordered.disk.border.push_back(number[v]);
  return ordered;
}

std::vector<BorderFreedom> renumbered(std::span<const BorderFreedom> freedoms,
                                      std::span<const int> number) {
  std::vector<BorderFreedom> result(freedoms.begin(), freedoms.end());
  for (BorderFreedom& freedom : result) {
    freedom.vertex = number[freedom.vertex];
    if (freedom.mate >= 0) freedom.mate = number[freedom.mate];
  }
  return result;
}

}  // namespace weft
