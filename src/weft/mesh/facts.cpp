#include "weft/mesh/facts.h"

#include <algorithm>
#include <cmath>

#include "weft/mesh/crossings.h"
#include "weft/mesh/edge_uses.h"
#include "weft/mesh/repair.h"
#include "weft/mesh/surface_facts.h"
#include "weft/mesh/surface_parts.h"

namespace weft {
namespace {

constexpr double sliver_quality = 0.01;
constexpr std::size_t most_listed_crossings = 20;

bool is_finite(Vec3d p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

void examine_vertices(const TriangleMesh& mesh, MeshFacts& facts) {
  std::vector<bool> used(mesh.positions.size(), false);
  for (const Triangle& t : mesh.triangles)
    for (const int v : t) used[v] = true;
  facts.unreferenced_vertices = static_cast<int>(std::count(used.begin(), used.end(), false));
  for (const Vec3d p : mesh.positions)
    if (is_finite(p))
      facts.box.add(p);
    else
      ++facts.not_finite_vertices;
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

void examine_triangles(const TriangleMesh& mesh, MeshFacts& facts) {
  const auto vertices = static_cast<int>(mesh.positions.size());
  const std::vector<bool> twins =
      duplicate_triangles(mesh.triangles, edge_uses(vertices, mesh.triangles));
  facts.duplicate_triangles = static_cast<int>(std::count(twins.begin(), twins.end(), true));
  double volume = 0;
  for (const auto& [a, b, c] : corners_of(mesh)) {
    facts.zero_area_triangles += has_no_area({a, b, c}) ? 1 : 0;
    const double quality = triangle_quality(a, b, c);
    facts.slivers += quality < sliver_quality ? 1 : 0;
    facts.least_quality = std::min(facts.least_quality, quality);
    facts.area += 0.5 * length(cross(b - a, c - a));
    const Vec3d origin = facts.box.lower;  // near by, so that little is lost by rounding
    volume += dot(a - origin, cross(b - origin, c - origin)) / 6;
  }
  if (facts.closed && facts.inconsistent_edges == 0) facts.volume = volume;
}

void find_crossings(const SoundPart& part, MeshFacts& facts) {
  std::vector<bool> crossing(part.source.size(), false);
  std::vector<std::array<int, 2>>& list = facts.self_intersection_list;
  const auto keep_first = [&] {
    std::sort(list.begin(), list.end());
    list.resize(std::min(list.size(), most_listed_crossings));
  };
  for_self_crossings(corners_of(part.mesh), [&](int s, int t) {
    ++facts.self_intersections;
    crossing[s] = crossing[t] = true;
    list.push_back({part.source[s], part.source[t]});
    if (list.size() > 100 * most_listed_crossings) keep_first();
  });
  keep_first();
  facts.intersecting_triangles =
      static_cast<int>(std::count(crossing.begin(), crossing.end(), true));
}

}  // namespace

double triangle_quality(Vec3d a, Vec3d b, Vec3d c) {
  const double edges = squared_length(b - a) + squared_length(c - b) + squared_length(a - c);
  return edges > 0 ? 2 * std::sqrt(3.0) * length(cross(b - a, c - a)) / edges : 0;
}

MeshFacts examine_mesh(const TriangleMesh& mesh) {
  MeshFacts facts;
  facts.vertices = static_cast<int>(mesh.positions.size());
  facts.triangles = static_cast<int>(mesh.triangles.size());
  facts.texture_coordinates = !mesh.corner_uv.empty();
  examine_vertices(mesh, facts);
  const SoundPart sound = sound_part(mesh);
  facts.repeated_vertex_triangles = facts.triangles - static_cast<int>(sound.source.size());
  facts.coincident_vertices =
      facts.vertices - static_cast<int>(weld_exact(sound.mesh).positions.size());
  examine_surface(sound.mesh, facts);
  examine_triangles(sound.mesh, facts);
  find_crossings(sound, facts);
  return facts;
}

}  // namespace weft
