#include "weft/repair.h"

#include <algorithm>
#include <climits>
#include <cstdint>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "weft/core/assert.h"
#include "weft/error.h"
#include "weft/mesh/manifold.h"
#include "weft/mesh/partition.h"
#include "weft/mesh/surface_parts.h"
#include "weft/mesh/topology.h"
#include "weft/mesh/weld.h"

namespace weft {
namespace {

void check_values(const TriangleMesh& mesh, const std::string& name) {
  if (mesh.positions.empty()) throw InputError(name, "has no vertices", "a mesh is wanted");
  if (mesh.triangles.empty()) throw InputError(name, "has no triangles", "a surface is wanted");
  if (mesh.triangles.size() > INT_MAX / 3 || mesh.positions.size() > INT_MAX / 3)
    throw InputError(name, "has too many vertices or triangles",
                     fmt::format("at most {} of each are wanted", INT_MAX / 3));
  // Up to 1e30, areas and volumes stay far from overflow.
  const auto fits = [](double x) { return std::fabs(x) <= 1e30; };
  WEFT_ASSERT(mesh.corner_uv.empty() || mesh.corner_uv.size() == mesh.triangles.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3d p = mesh.positions[v];
    if (!fits(p.x) || !fits(p.y) || !fits(p.z))
      throw InputError(name, fmt::format("vertex {} is at ({}, {}, {})", v, p.x, p.y, p.z),
                       "finite coordinates up to 1e30 are wanted");
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const int v : mesh.triangles[t])
      if (v < 0 || std::cmp_greater_equal(v, mesh.positions.size()))
        throw InputError(
            name, fmt::format("triangle {} uses vertex {} of {}", t, v, mesh.positions.size()),
            "an existing vertex is wanted");
}

/// "1 triangle", "2 triangles"; for words whose plural is an s.
std::string counted(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}
std::string vertices(std::size_t count) {
  return fmt::format("{} {}", count, count == 1 ? "vertex" : "vertices");
}

bool has_area(const TriangleMesh& mesh, const Triangle& t) {
  const auto& p = mesh.positions;
  return squared_length(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]])) > 0;
}

/// Whether any triangle has an area, up to rounding.
bool has_area(const TriangleMesh& mesh) {
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(),
                     [&](const Triangle& t) { return has_area(mesh, t); });
}

/// The repair of one mesh, step by step; each step reports its changes.
class Repair {
 public:
  Repair(const TriangleMesh& mesh, const RepairOptions& options)
      : mesh_(mesh), source_triangles_(mesh.triangles), options_(options) {
    check_values(mesh, options.name);
    result_.source_vertex.resize(mesh.positions.size());
    std::iota(result_.source_vertex.begin(), result_.source_vertex.end(), 0);
    result_.source_triangle.resize(mesh.triangles.size());
    std::iota(result_.source_triangle.begin(), result_.source_triangle.end(), 0);
  }

  int count_components() {
    drop_triangles();
    return surface_parts(mesh_, edges_).count;
  }

  RepairedMesh run() {
    drop_triangles();
    note_unreferenced();
    if (options_.component.kind == ComponentChoice::Kind::all) weld_parts();
    choose_component();
    if (!has_area(mesh_))
      throw InputError(options_.name, "no triangle has an area", "a surface is wanted");
    orient();
    carry_corner_uv();
    choose_parts();
    if (is_parted())
      part();
    else
      split_vertices();
    drop_unused_vertices();
    result_.counts = counts();
    result_.mesh = std::move(mesh_);
    return std::move(result_);
  }

 private:
  void report(std::string sentence) { result_.repairs.push_back(std::move(sentence)); }
  void find_edges() {
    edges_ = edge_uses(static_cast<int>(mesh_.positions.size()), mesh_.triangles);
  }

  /// Removes triangles where `keep(index)` is false; the order stays. @return how many were removed
  template <class Keep>
  std::size_t keep_triangles(const Keep& keep) {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (!keep(t)) continue;
      mesh_.triangles[kept] = mesh_.triangles[t];
      result_.source_triangle[kept++] = result_.source_triangle[t];
    }
    const std::size_t dropped = mesh_.triangles.size() - kept;
    mesh_.triangles.resize(kept);
    result_.source_triangle.resize(kept);
    return dropped;
  }

  void drop_triangles() {
    const std::size_t repeated =
        keep_triangles([&](std::size_t t) { return !repeats_a_vertex(mesh_.triangles[t]); });
    if (repeated > 0)
      report(fmt::format("dropped {} with a repeated vertex", counted(repeated, "triangle")));
    if (mesh_.triangles.empty())
      throw InputError(options_.name, "every triangle has a repeated vertex",
                       "a surface is wanted");
    find_edges();
    const std::vector<bool> duplicate = duplicate_triangles(mesh_.triangles, edges_);
    const std::size_t duplicates = keep_triangles([&](std::size_t t) { return !duplicate[t]; });
    if (duplicates == 0) return;
    report(fmt::format("dropped {} with the same vertices as another",
                       counted(duplicates, "triangle")));
    find_edges();
  }

  /// Reports vertices that the input leaves unreferenced, not those that the choice of a component
  /// will.
  void note_unreferenced() {
    const std::vector<bool> used = used_vertices();
    const auto unused = static_cast<std::size_t>(std::count(used.begin(), used.end(), false));
    if (unused > 0) report(fmt::format("dropped {} without triangles", vertices(unused)));
  }

  void weld_parts() {
    Welding found = find_welding(mesh_, edges_);
    if (found.first.empty()) return;
    std::size_t joined = 0;
    const std::vector<bool> used = used_vertices();
    for (std::size_t v = 0; v < used.size(); ++v)
      joined += used[v] && found.first[v] != static_cast<int>(v) ? 1 : 0;
    weld(mesh_.triangles, found.first);
    keep_triangles([&](std::size_t t) { return !repeats_a_vertex(mesh_.triangles[t]); });
    result_.welded = std::move(found.first);
    report(fmt::format("welded {} to others at the same position, which closes {}",
                       vertices(joined), counted(found.closed_borders, "border edge")));
    find_edges();
  }

  [[nodiscard]] bool is_parted() const {
    return std::find(parted_.begin(), parted_.end(), true) != parted_.end();
  }

  void choose_component() {
    const SurfaceParts parts = surface_parts(mesh_, edges_);
    result_.components_found = parts.count;
    const ComponentChoice& choice = options_.component;
    if (choice.kind == ComponentChoice::Kind::all) return drop_flat_parts(parts);
    if (choice.kind == ComponentChoice::Kind::only) {
      // Non-manifold edges first: choosing a component might not remove them.
      require_manifold_edges(mesh_.triangles, edges_, options_.name);
      if (parts.count > 1)
        throw TopologyError(options_.name, fmt::format("{} components", parts.count),
                            "one is wanted, or --component K, largest or all");
      return;
    }
    const int wanted = choice.kind == ComponentChoice::Kind::largest ? 0 : choice.index;
    if (wanted < 0 || wanted >= parts.count)
      throw TopologyError(options_.name,
                          fmt::format("component {} of {} was asked for", wanted, parts.count),
                          fmt::format("0 to {} is wanted", parts.count - 1));
    if (parts.count > 1) keep_part(parts, wanted);
    require_manifold_edges(mesh_.triangles, edges_, options_.name);
  }

  void keep_part(const SurfaceParts& parts, int wanted) {
    const std::size_t before = mesh_.triangles.size();
    keep_triangles([&](std::size_t t) { return parts.part_of[t] == wanted; });
    report(fmt::format("kept component {} of {} with {} of {} triangles", wanted, parts.count,
                       mesh_.triangles.size(), before));
    find_edges();
  }

  /// Nothing can be sampled of a component that has no area; where none has one, that is an error.
  void drop_flat_parts(const SurfaceParts& parts) {
    std::vector<bool> has_area(static_cast<std::size_t>(parts.count), false);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      if (weft::has_area(mesh_, mesh_.triangles[t])) has_area[parts.part_of[t]] = true;
    const auto flat = static_cast<std::size_t>(std::count(has_area.begin(), has_area.end(), false));
    if (flat == 0 || flat == has_area.size()) return;
    keep_triangles([&](std::size_t t) { return has_area[parts.part_of[t]]; });
    report(fmt::format("dropped {} without area", counted(flat, "component")));
    find_edges();
  }

  void orient() {
    int turned = 0;
    if (options_.component.kind == ComponentChoice::Kind::all) {
      turned = orient_parts(mesh_.triangles, edges_, parted_);
    } else {
      turned = orient_triangles(mesh_.triangles, edges_, options_.name);
      parted_.assign(static_cast<std::size_t>(edges_.edge_count()), false);
    }
    if (turned > 0) report(fmt::format("oriented {}", counted(turned, "triangle")));
    const SurfaceParts parts = surface_parts(mesh_, edges_);
    const std::vector<bool> inside_out = inside_out_parts(mesh_, edges_, parts);
    std::size_t turned_outward = 0;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (!inside_out[parts.part_of[t]]) continue;
      std::swap(mesh_.triangles[t][1], mesh_.triangles[t][2]);
      ++turned_outward;
    }
    if (turned_outward > 0)
      report(fmt::format("turned the closed surface outward, {}",
                         counted(turned_outward, "triangle")));
  }

  /// Reports where the surface has to be parted, and parts it where that is asked for besides.
  void choose_parts() {
    std::size_t branching = 0, unoriented = 0;
    for (int e = 0; e < edges_.edge_count(); ++e) {
      branching += parted_[e] && edges_.of(e).size() > 2 ? 1 : 0;
      unoriented += parted_[e] && edges_.of(e).size() == 2 ? 1 : 0;
    }
    if (branching > 0)
      report(fmt::format("parted at {} of more than two triangles", counted(branching, "edge")));
    if (unoriented > 0)
      report(fmt::format("parted at {} where the surface cannot be oriented",
                         counted(unoriented, "edge")));
    const bool is_asked = options_.part.at_texture_seams || options_.part.regions > 0;
    if (!is_asked && !is_parted()) return;
    find_edges();  // the same edges in the same order, of triangles as they lie now
    if (options_.part.at_texture_seams)
      report(
          fmt::format("parted at {} between islands of the texture",
                      counted(std::size_t(part_at_texture_seams(mesh_, edges_, parted_)), "edge")));
    if (options_.part.regions > 0)
      report(fmt::format(
          "parted into {}",
          counted(std::size_t(part_in_regions(mesh_, edges_, options_.part, parted_)), "region")));
  }

  void part() {
    lengthen_slits(mesh_, edges_, parted_);
    PartedVertices made =
        part_vertices(static_cast<int>(mesh_.positions.size()), mesh_.triangles, edges_, parted_);
    for (std::size_t v = mesh_.positions.size(); v < made.source_vertex.size(); ++v) {
      const int source = made.source_vertex[v];
      mesh_.positions.push_back(mesh_.positions[source]);
      result_.source_vertex.push_back(result_.source_vertex[source]);
    }
    result_.joined = std::move(made.joined);
  }

  [[nodiscard]] TopologyCounts counts() const {
    const auto vertices = static_cast<int>(mesh_.positions.size());
    if (result_.joined.empty()) return count_topology(vertices, mesh_.triangles);
    std::vector<Triangle> joined = mesh_.triangles;
    for (Triangle& t : joined)
      for (int& v : t) v = result_.joined[v];
    return count_complex(*std::max_element(result_.joined.begin(), result_.joined.end()) + 1,
                         joined);
  }

  void split_vertices() {
    const VertexSplit split = split_fans(static_cast<int>(mesh_.positions.size()), mesh_.triangles);
    if (split.split_vertices == 0) return;
    for (std::size_t v = mesh_.positions.size(); v < split.source_vertex.size(); ++v) {
      const int source = split.source_vertex[v];
      mesh_.positions.push_back(mesh_.positions[source]);
      result_.source_vertex.push_back(result_.source_vertex[source]);
    }
    report(fmt::format("split {} non-manifold {} into {} fans", split.split_vertices,
                       split.split_vertices == 1 ? "vertex" : "vertices", split.fans));
  }

  void drop_unused_vertices() {
    const std::vector<bool> used = used_vertices();
    std::vector<int> place(used.size(), -1);
    int kept = 0;
    for (std::size_t v = 0; v < used.size(); ++v) {
      if (!used[v]) continue;
      mesh_.positions[kept] = mesh_.positions[v];
      result_.source_vertex[kept] = result_.source_vertex[v];
      if (!result_.joined.empty()) result_.joined[kept] = result_.joined[v];
      place[v] = kept++;
    }
    if (!result_.joined.empty()) result_.joined.resize(kept);
    mesh_.positions.resize(kept);
    result_.source_vertex.resize(kept);
    for (Triangle& t : mesh_.triangles)
      for (int& v : t) v = place[v];
  }

  /// Reorders texture coordinates: the corners of a flipped triangle have another order than in its
  /// source.
  void carry_corner_uv() {
    if (mesh_.corner_uv.empty()) return;
    std::vector<std::array<Vec2f, 3>> carried(mesh_.triangles.size());
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const int source = result_.source_triangle[t];
      for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 3; ++j)
          if (welded(source_triangles_[source][j]) == result_.source_vertex[mesh_.triangles[t][k]])
            carried[t][k] = mesh_.corner_uv[source][j];
    }
    mesh_.corner_uv = std::move(carried);
  }

  [[nodiscard]] int welded(int vertex) const {
    return result_.welded.empty() ? vertex : result_.welded[vertex];
  }
  [[nodiscard]] std::vector<bool> used_vertices() const {
    std::vector<bool> used(mesh_.positions.size(), false);
    for (const Triangle& t : mesh_.triangles)
      for (const int v : t) used[v] = true;
    return used;
  }

  TriangleMesh mesh_;
  const std::vector<Triangle>& source_triangles_;
  const RepairOptions& options_;
  std::vector<bool> parted_;  ///< [E] where the surface is parted
  EdgeUses edges_;            ///< of mesh_, until triangles are flipped
  RepairedMesh result_;
};

}  // namespace

RepairedMesh repair_mesh(const TriangleMesh& mesh, const RepairOptions& options) {
  return Repair(mesh, options).run();
}

int count_components(const TriangleMesh& mesh, const std::string& name) {
  return Repair(mesh, {name, {}}).count_components();
}

}  // namespace weft
