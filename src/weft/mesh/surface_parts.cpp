#include "weft/mesh/surface_parts.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/mesh/topology.h"

namespace weft {
namespace {

/// Labels the components of triangles connected by edges, in order of their first triangle.
int label_parts(const EdgeUses& edges, std::vector<int>& part_of) {
  std::vector<int> parent(part_of.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int t) {
    while (parent[t] != t) t = parent[t] = parent[parent[t]];
    return t;
  };
  for (int e = 0; e < edges.edge_count(); ++e)
    for (const int h : edges.of(e)) {
      const int a = root(edges.of(e)[0] / 3);
      const int b = root(h / 3);
      parent[std::max(a, b)] = std::min(a, b);
    }
  int count = 0;
  for (int t = 0; t < static_cast<int>(parent.size()); ++t)
    part_of[t] = root(t) == t ? count++ : part_of[root(t)];
  return count;
}

struct PartSize {
  double area = 0;
  int min_vertex = 0;
  int label = 0;
};

std::vector<PartSize> measure_parts(const TriangleMesh& mesh, const SurfaceParts& parts) {
  std::vector<PartSize> sizes(parts.count);
  for (int i = 0; i < parts.count; ++i) sizes[i] = {0, static_cast<int>(mesh.positions.size()), i};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& corners = mesh.triangles[t];
    const Vec3d a = mesh.positions[corners[0]];
    PartSize& size = sizes[parts.part_of[t]];
    size.area +=
        0.5 * length(cross(mesh.positions[corners[1]] - a, mesh.positions[corners[2]] - a));
    size.min_vertex = std::min({size.min_vertex, corners[0], corners[1], corners[2]});
  }
  return sizes;
}

struct PartShape {
  bool closed = true;
  int first_vertex = -1;
  double volume = 0;  ///< six times what it encloses, positive when its triangles face outward
  Box3d box;
};

std::vector<PartShape> part_shapes(const TriangleMesh& mesh, const EdgeUses& edges,
                                   const SurfaceParts& parts) {
  std::vector<PartShape> shapes(static_cast<std::size_t>(parts.count));
  for (int e = 0; e < edges.edge_count(); ++e)
    if (edges.of(e).size() != 2) shapes[parts.part_of[edges.of(e)[0] / 3]].closed = false;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    PartShape& shape = shapes[parts.part_of[t]];
    const Triangle& corners = mesh.triangles[t];
    if (shape.first_vertex < 0) shape.first_vertex = corners[0];
    const Vec3d origin = mesh.positions[shape.first_vertex];
    const Vec3d a = mesh.positions[corners[0]] - origin, b = mesh.positions[corners[1]] - origin;
    shape.volume += dot(mesh.positions[corners[2]] - origin, cross(a, b));
    for (const int v : corners) shape.box.add(mesh.positions[v]);
  }
  return shapes;
}

bool contains(const Box3d& outer, const Box3d& inner) {
  return outer.lower.x <= inner.lower.x && outer.lower.y <= inner.lower.y &&
         outer.lower.z <= inner.lower.z && outer.upper.x >= inner.upper.x &&
         outer.upper.y >= inner.upper.y && outer.upper.z >= inner.upper.z;
}

}  // namespace

std::vector<bool> duplicate_triangles(std::span<const Triangle> triangles, const EdgeUses& edges) {
  std::vector<bool> duplicate(triangles.size(), false);
  std::vector<std::pair<int, int>> opposite;  // vertex across the edge, triangle
  for (int e = 0; e < edges.edge_count(); ++e) {
    if (edges.of(e).size() < 2) continue;
    opposite.clear();
    for (const int h : edges.of(e))
      opposite.emplace_back(from_vertex(triangles, HalfEdges::previous(h)), h / 3);
    std::sort(opposite.begin(), opposite.end());
    for (std::size_t i = 1; i < opposite.size(); ++i)
      if (opposite[i].first == opposite[i - 1].first) duplicate[opposite[i].second] = true;
  }
  return duplicate;
}

SurfaceParts surface_parts(const TriangleMesh& mesh, const EdgeUses& edges) {
  SurfaceParts parts;
  parts.part_of.resize(mesh.triangles.size());
  parts.count = label_parts(edges, parts.part_of);
  std::vector<PartSize> sizes = measure_parts(mesh, parts);
  std::sort(sizes.begin(), sizes.end(), [](const PartSize& a, const PartSize& b) {
    return std::tuple(-a.area, a.min_vertex, a.label) < std::tuple(-b.area, b.min_vertex, b.label);
  });
  std::vector<int> rank(parts.count);
  for (int i = 0; i < parts.count; ++i) rank[sizes[i].label] = i;
  for (int& part : parts.part_of) part = rank[part];
  return parts;
}

void require_manifold_edges(std::span<const Triangle> triangles, const EdgeUses& edges,
                            std::string_view mesh_name) {
  int count = 0, first = -1;
  for (int e = 0; e < edges.edge_count(); ++e) {
    if (edges.of(e).size() <= 2) continue;
    if (count++ == 0) first = e;
  }
  if (count == 0) return;
  throw TopologyError(mesh_name,
                      fmt::format("{} non-manifold edge{}, the first between {} with {} triangles",
                                  count, count == 1 ? "" : "s", edge_name(triangles, edges, first),
                                  edges.of(first).size()),
                      "at most two triangles at an edge are wanted");
}

std::vector<bool> inside_out_parts(const TriangleMesh& mesh, const EdgeUses& edges,
                                   const SurfaceParts& parts) {
  const std::vector<PartShape> shapes = part_shapes(mesh, edges, parts);
  std::vector<bool> inside_out(shapes.size(), false);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (!shapes[i].closed || shapes[i].volume >= 0) continue;
    inside_out[i] = std::none_of(shapes.begin(), shapes.end(), [&](const PartShape& other) {
      return other.closed && other.volume > 0 && contains(other.box, shapes[i].box);
    });
  }
  return inside_out;
}

}  // namespace weft
