#include "weft/mesh_statistics.h"

#include <algorithm>
#include <cmath>

#include "weft/mesh/crossings.h"
#include "weft/mesh/edge_uses.h"
#include "weft/mesh/surface_parts.h"
#include "weft/mesh/surface_statistics.h"
#include "weft/repair.h"

namespace weft {
namespace {

constexpr double sliver_quality = 0.01;
constexpr std::size_t max_listed_crossings = 20;

bool is_finite(Vec3d p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

void examine_vertices(const TriangleMesh& mesh, MeshStatistics& statistics) {
  std::vector<bool> used(mesh.positions.size(), false);
  for (const Triangle& t : mesh.triangles)
    for (const int v : t) used[v] = true;
  statistics.unreferenced_vertices = static_cast<int>(std::count(used.begin(), used.end(), false));
  for (const Vec3d p : mesh.positions)
    if (is_finite(p))
      statistics.box.add(p);
    else
      ++statistics.not_finite_vertices;
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
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
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
    const Vec3d origin = statistics.box.lower;  // near by, so that little is lost by rounding
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
  for_self_crossings(corners_of(part.mesh), [&](int s, int t) {
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
