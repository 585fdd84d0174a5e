#include "weft/mesh/surface_statistics.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "weft/core/disjoint_sets.h"
#include "weft/mesh/edge_uses.h"
#include "weft/mesh/surface_parts.h"
#include "weft/mesh/topology.h"

namespace weft {
namespace {

/// Gathers the statistics edge by edge. A corner of a triangle is named like the half-edge that
/// leaves it; corners joined over the edges that they share at a vertex make a fan.
class SurfaceExamination {
 public:
  SurfaceExamination(const TriangleMesh& mesh, MeshStatistics& statistics)
      : mesh_(mesh),
        statistics_(statistics),
        edges_(edge_uses(static_cast<int>(mesh.positions.size()), mesh.triangles)),
        parts_(surface_parts(mesh, edges_)),
        turns_(static_cast<int>(mesh.triangles.size())),
        fans_(3 * static_cast<int>(mesh.triangles.size())) {}

  void run() {
    statistics_.components = parts_.count;
    statistics_.component_list.resize(parts_.count);
    for (int e = 0; e < edges_.edge_count(); ++e) examine_edge(edges_.of(e));
    count_triangles();
    count_fans();
    collect_loops();
    statistics_.closed = parts_.count > 0;
    for (const ComponentStatistics& component : statistics_.component_list) {
      statistics_.orientable = statistics_.orientable && component.orientable;
      statistics_.closed = statistics_.closed && component.closed();
    }
  }

 private:
  ComponentStatistics& component_at(int half_edge) {
    return statistics_.component_list[parts_.part_of[HalfEdges::triangle_of(half_edge)]];
  }
  [[nodiscard]] int from(int half_edge) const { return from_vertex(mesh_.triangles, half_edge); }
  [[nodiscard]] int to(int half_edge) const { return to_vertex(mesh_.triangles, half_edge); }

  void examine_edge(std::span<const int> along) {
    const int one = along.front();
    ComponentStatistics& component = component_at(one);
    ++component.edges;
    if (along.size() == 1) {
      ++statistics_.border_edges;
      ++component.border_edges;
      return;
    }
    for (const int other : along.subspan(1)) join_fans(one, other);
    if (along.size() > 2) {
      ++statistics_.nonmanifold_edges;
      ++component.nonmanifold_edges;
      statistics_.nonmanifold_edge_list.push_back(
          {std::min(from(one), to(one)), std::max(from(one), to(one))});
      return;
    }
    const bool agree = from(one) == to(along[1]);
    if (!agree) ++statistics_.inconsistent_edges;
    if (!turns_.join(HalfEdges::triangle_of(one), HalfEdges::triangle_of(along[1]), agree ? 0 : 1))
      component.orientable = false;
  }

  void join_fans(int one, int other) {
    const int end = HalfEdges::next(one), other_end = HalfEdges::next(other);
    const bool opposed = from(one) != from(other);
    fans_.join(one, opposed ? other_end : other);
    fans_.join(end, opposed ? other : other_end);
  }

  void count_triangles() {
    for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t) {
      const auto& [a, b, c] = mesh_.triangles[t];
      const Vec3d p = mesh_.positions[a];
      ComponentStatistics& component = component_at(3 * t);
      ++component.triangles;
      component.area += 0.5 * length(cross(mesh_.positions[b] - p, mesh_.positions[c] - p));
    }
  }

  void count_fans() {
    std::vector<int> fans(mesh_.positions.size(), 0);
    for (int corner = 0; corner < 3 * static_cast<int>(mesh_.triangles.size()); ++corner) {
      if (fans_.root(corner) != corner) continue;
      ++component_at(corner).vertices;
      ++fans[from(corner)];
    }
    for (int v = 0; v < static_cast<int>(fans.size()); ++v)
      if (fans[v] > 1) statistics_.nonmanifold_vertex_list.push_back(v);
    statistics_.nonmanifold_vertices = static_cast<int>(statistics_.nonmanifold_vertex_list.size());
  }

  /// Border edges are joined where they meet in one fan, so that loops which touch at a
  /// non-manifold vertex stay two.
  void collect_loops() {
    DisjointSets loops(3 * static_cast<int>(mesh_.triangles.size()));
    for_border([&](int h) { loops.join(fans_.root(h), fans_.root(HalfEdges::next(h))); });
    std::vector<int> loop_of(3 * mesh_.triangles.size(), -1);
    for_border([&](int h) {
      int& loop = loop_of[loops.root(fans_.root(h))];
      const int least = std::min(from(h), to(h));
      if (loop < 0) {
        loop = static_cast<int>(statistics_.border_loops.size());
        statistics_.border_loops.push_back(
            {0, 0, parts_.part_of[HalfEdges::triangle_of(h)], least});
        ++component_at(h).boundaries;
      }
      BorderLoopStatistics& found = statistics_.border_loops[loop];
      ++found.edges;
      found.length += length(mesh_.positions[to(h)] - mesh_.positions[from(h)]);
      found.min_vertex = std::min(found.min_vertex, least);
    });
    std::sort(statistics_.border_loops.begin(), statistics_.border_loops.end(),
              [](const BorderLoopStatistics& a, const BorderLoopStatistics& b) {
                return std::tuple(-a.length, a.min_vertex, a.component, a.edges) <
                       std::tuple(-b.length, b.min_vertex, b.component, b.edges);
              });
  }
  template <class Visit>
  void for_border(const Visit& visit) const {
    for (int e = 0; e < edges_.edge_count(); ++e)
      if (edges_.of(e).size() == 1) visit(edges_.of(e).front());
  }

  const TriangleMesh& mesh_;
  MeshStatistics& statistics_;
  EdgeUses edges_;
  SurfaceParts parts_;
  DisjointSets turns_, fans_;
};

}  // namespace

void examine_surface(const TriangleMesh& mesh, MeshStatistics& statistics) {
  SurfaceExamination(mesh, statistics).run();
}

}  // namespace weft
