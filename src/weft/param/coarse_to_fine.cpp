#include "weft/param/coarse_to_fine.h"

#include <algorithm>

#include "weft/mesh/topology.h"
#include "weft/param/collapse_passes.h"
#include "weft/param/disk_geometry.h"
#include "weft/param/progressive_embedding.h"
#include "weft/param/triangle_energy.h"

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

/// Gives the energy of the triangles of all coarser versions of a disk.
class Triangles {
 public:
  /// @param uv  [D] the border given
  Triangles(const DiskMesh& disk, std::span<const Vec2d> uv);
  [[nodiscard]] double mean_area() const { return mean_area_; }
  [[nodiscard]] StarTriangle operator()(const Triangle& t) const;

 private:
  const DiskMesh& disk_;
  double mean_area_ = 0;
  double inverse_unit_ = 0;      ///< factor of inverse_weight
  std::vector<double> quartic_;  ///< [D] area-weighted mean of the curvature weights of the
                                 ///< triangles around the vertex
};

Triangles::Triangles(const DiskMesh& disk, std::span<const Vec2d> uv)
    : disk_(disk), quartic_(disk.positions.size(), 0.0) {
  const std::vector<SurfaceTriangle> surface = surface_triangles(disk.positions, disk.triangles);
  const HalfEdges edges = half_edges(static_cast<int>(disk.positions.size()), disk.triangles);
  const std::vector<double> curvature_weight = curvature_weights(disk, edges, surface);
  std::vector<double> around(disk.positions.size(), 0.0);
  double area = 0;
  for (std::size_t t = 0; t < surface.size(); ++t) {
    area += surface[t].area;
    for (const int v : disk.triangles[t]) {
      quartic_[v] += surface[t].area * curvature_weight[t];
      around[v] += surface[t].area;
    }
  }
  mean_area_ = area / static_cast<double>(surface.size());
  double plane = 0;
  for (std::size_t b = 0; b < disk.border.size(); ++b)
    plane += 0.5 * cross(uv[disk.border[b]], uv[disk.border[(b + 1) % disk.border.size()]]);
  inverse_unit_ = (area / plane) * (area / plane);
  for (std::size_t v = 0; v < quartic_.size(); ++v)
    quartic_[v] = around[v] > 0 ? quartic_[v] / around[v] * plane / area : 0;
}

/// The triangle's metric plus a small equilateral one: a triangle without area would not be a
/// barrier to its neighbours otherwise.
StarTriangle Triangles::operator()(const Triangle& t) const {
  const double min = 1e-8 * mean_area_;
  const Vec3d p = disk_.positions[t[1]] - disk_.positions[t[0]];
  const Vec3d q = disk_.positions[t[2]] - disk_.positions[t[0]];
  const SurfaceTriangle surface{dot(p, p) + min, dot(p, q) + 0.5 * min, dot(q, q) + min,
                                0.5 * length(cross(p, q)) + min};
  return {surface, (quartic_[t[0]] + quartic_[t[1]] + quartic_[t[2]]) / 3,
          inverse_unit_ * inverse_weight(surface)};
}

/// [D] the index of each vertex in a list of them, -1 where it is not there.
std::vector<int> places_in(std::span<const int> list, std::size_t vertices) {
  std::vector<int> place(vertices, -1);
  for (std::size_t i = 0; i < list.size(); ++i) place[list[i]] = static_cast<int>(i);
  return place;
}

bool map_what_is_left(const CollapseHierarchy& mesh, const DiskMesh& disk, std::span<Vec2d> uv,
                      const MapDisk& map, std::span<const BorderFreedom> freedoms) {
  const CoarseDisk coarse = coarse_disk(mesh, disk);
  std::vector<Vec2d> coarse_uv;
  for (const int v : coarse.vertex) coarse_uv.push_back(uv[v]);
  if (!map(coarse.disk, coarse_uv, renumbered(freedoms, places_in(coarse.vertex, uv.size()))))
    return false;
  for (std::size_t v = 0; v < coarse.vertex.size(); ++v) uv[coarse.vertex[v]] = coarse_uv[v];
  return true;
}

bool map_as_numbered(const DiskMesh& disk, std::span<Vec2d> uv, const MapDisk& map,
                     const CoarseToFineOptions& options) {
  constexpr int triangles_per_border_edge = 8;
  const Triangles triangles(disk, uv);
  const CollapseOrder order = shortest_first(disk);
  CollapseHierarchy mesh(disk);
  int wanted =
      std::max(options.triangles, triangles_per_border_edge * static_cast<int>(disk.border.size()));
  for (int left = -1;; wanted = left / 4) {
    collapse_in_passes(mesh, order,
                       {.triangles = wanted, .first_cost = triangles.mean_area(), .growth = 1.5});
    if (mesh.triangle_count() == left) return false;
    left = mesh.triangle_count();
    if (map_what_is_left(mesh, disk, uv, map, options.freedoms)) break;
  }
  ReinsertionOptions back{.triangle = triangles,
                          .growth = options.growth,
                          .sweeps = options.sweeps,
                          .many = options.many,
                          .freedoms = options.freedoms,
                          .threads = options.threads,
                          .progress = options.progress};
  return bring_back(mesh, uv, back) && is_valid_map(disk.triangles, uv);
}

/// In a numbering that keeps neighbours together.
bool map_in_order(const DiskMesh& disk, std::span<Vec2d> uv, const MapDisk& map,
                  CoarseToFineOptions options) {
  const OrderedDisk ordered = breadth_first(disk);
  const std::vector<BorderFreedom> freedoms =
      renumbered(options.freedoms, places_in(ordered.vertex, uv.size()));
  options.freedoms = freedoms;
  std::vector<Vec2d> own;
  own.reserve(uv.size());
  for (const int v : ordered.vertex) own.push_back(uv[v]);
  const bool found = map_as_numbered(ordered.disk, own, map, options);
  for (std::size_t v = 0; v < own.size(); ++v) uv[ordered.vertex[v]] = own[v];
  return found;
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

bool map_coarse_to_fine(const DiskMesh& disk, std::span<Vec2d> uv, const MapDisk& map,
                        const CoarseToFineOptions& options) {
  const bool is_large = static_cast<int>(disk.triangles.size()) > options.many;
  return is_large ? map_in_order(disk, uv, map, options) : map_as_numbered(disk, uv, map, options);
}

}  // namespace weft
