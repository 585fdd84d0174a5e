#include "weft/mesh_statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "weft/core/disjoint_sets.h"
#include "weft/mesh/crossings.h"
#include "weft/mesh/surface_parts.h"
#include "weft/mesh/topology.h"
#include "weft/repair.h"

namespace weft {
namespace {

/// Gathers the statistics edge by edge. A corner of a triangle has the index of the half-edge that
/// leaves it; corners at a vertex that are joined through shared edges form a fan.
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
      const int min = std::min(from(h), to(h));
      if (loop < 0) {
        loop = static_cast<int>(statistics_.border_loops.size());
        statistics_.border_loops.push_back({0, 0, parts_.part_of[HalfEdges::triangle_of(h)], min});
        ++component_at(h).boundaries;
      }
      BorderLoopStatistics& found = statistics_.border_loops[loop];
      ++found.edges;
      found.length += length(mesh_.positions[to(h)] - mesh_.positions[from(h)]);
      found.min_vertex = std::min(found.min_vertex, min);
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

/// Examines the connectivity of a mesh: components, borders, non-manifold edges and vertices,
/// orientation.
/// @param mesh  finite; no triangle with a repeated vertex
void examine_surface(const TriangleMesh& mesh, MeshStatistics& statistics) {
  SurfaceExamination(mesh, statistics).run();
}

constexpr double sliver_quality = 0.01;
constexpr std::size_t max_listed_crossings = 20;

bool is_finite(Vec3d p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

void examine_vertices(const TriangleMesh& mesh, MeshStatistics& statistics) {
  std::vector<bool> used(mesh.positions.size(), false);
  for (const Triangle& t : mesh.triangles)
    for (const int v : t) used[v] = true;
  statistics.unreferenced_vertices = static_cast<int>(std::count(used.begin(), used.end(), false));
  statistics.box = box_of(mesh);
  statistics.not_finite_vertices = static_cast<int>(
      std::ranges::count_if(mesh.positions, [](const Vec3d& p) { return !is_finite(p); }));
}

/// The triangles with three different vertices, on finite positions.
struct SoundPart {
  TriangleMesh mesh;
  std::vector<int> source;  ///< triangle of the whole mesh
};
SoundPart sound_part(const TriangleMesh& mesh) {
  SoundPart sound;
  for (const Vec3d p : mesh.positions) sound.mesh.positions.push_back(is_finite(p) ? p : Vec3d{});
  for (int i = 0; i < static_cast<int>(mesh.triangles.size()); ++i) {
    const Triangle& t = mesh.triangles[i];
    if (repeats_a_vertex(t)) continue;
    sound.mesh.triangles.push_back(t);
    sound.source.push_back(i);
  }
  return sound;
}

void examine_triangles(const TriangleMesh& mesh, MeshStatistics& statistics) {
  const auto vertices = static_cast<int>(mesh.positions.size());
  const std::vector<bool> twins =
      duplicate_triangles(mesh.triangles, edge_uses(vertices, mesh.triangles));
  statistics.duplicate_triangles = static_cast<int>(std::count(twins.begin(), twins.end(), true));
  double volume = 0;
  for (const auto& [a, b, c] : corners_of(mesh)) {
    statistics.zero_area_triangles += has_no_area({a, b, c}) ? 1 : 0;
    const double quality = triangle_quality(a, b, c);
    statistics.slivers += quality < sliver_quality ? 1 : 0;
    statistics.min_quality = std::min(statistics.min_quality, quality);
    statistics.area += 0.5 * length(cross(b - a, c - a));
    const Vec3d origin = statistics.box.lower;  // near the surface, to limit rounding errors
    volume += dot(a - origin, cross(b - origin, c - origin)) / 6;
  }
  if (statistics.closed && statistics.inconsistent_edges == 0) statistics.volume = volume;
}

void find_crossings(const SoundPart& part, MeshStatistics& statistics) {
  std::vector<bool> crossing(part.source.size(), false);
  std::vector<std::array<int, 2>>& list = statistics.self_intersection_list;
  const auto keep_first = [&] {
    std::sort(list.begin(), list.end());
    list.resize(std::min(list.size(), max_listed_crossings));
  };
  for_self_crossings(corners_of(part.mesh), Neighbours(part.mesh.triangles), [&](int s, int t) {
    ++statistics.self_intersections;
    crossing[s] = crossing[t] = true;
    list.push_back({part.source[s], part.source[t]});
    if (list.size() > 100 * max_listed_crossings) keep_first();
  });
  keep_first();
  statistics.intersecting_triangles =
      static_cast<int>(std::count(crossing.begin(), crossing.end(), true));
}

}  // namespace

double triangle_quality(Vec3d a, Vec3d b, Vec3d c) {
  const double edges = squared_length(b - a) + squared_length(c - b) + squared_length(a - c);
  return edges > 0 ? 2 * std::sqrt(3.0) * length(cross(b - a, c - a)) / edges : 0;
}

MeshStatistics examine_mesh(const TriangleMesh& mesh) {
  MeshStatistics statistics;
  statistics.vertices = static_cast<int>(mesh.positions.size());
  statistics.triangles = static_cast<int>(mesh.triangles.size());
  statistics.texture_coordinates = !mesh.corner_uv.empty();
  examine_vertices(mesh, statistics);
  const SoundPart sound = sound_part(mesh);
  statistics.repeated_vertex_triangles =
      statistics.triangles - static_cast<int>(sound.source.size());
  statistics.coincident_vertices =
      statistics.vertices - static_cast<int>(weld_exact(sound.mesh).positions.size());
  examine_surface(sound.mesh, statistics);
  examine_triangles(sound.mesh, statistics);
  find_crossings(sound, statistics);
  return statistics;
}

}  // namespace weft
