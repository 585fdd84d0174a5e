#include "weft/param/coarse_to_fine.h"

#include <algorithm>

#include "weft/param/collapse_passes.h"
#include "weft/param/disk_geometry.h"
#include "weft/param/reinsertion.h"

namespace weft {
namespace {

double mean_area(const DiskMesh& disk) {
  double sum = 0;
  for (const SurfaceTriangle& s : surface_triangles(disk.positions, disk.triangles)) sum += s.area;
  return sum / static_cast<double>(disk.triangles.size());
}

/// The triangle's own metric and a little of one with equal sides: one without area would else be
/// no barrier to its neighbours.
StarTriangle metric(const DiskMesh& disk, const Triangle& t, double mean) {
  constexpr double share = 1e-8;
  const Vec3d p = disk.positions[t[1]] - disk.positions[t[0]];
  const Vec3d q = disk.positions[t[2]] - disk.positions[t[0]];
  const double least = share * mean;
  return {{dot(p, p) + least, dot(p, q) + 0.5 * least, dot(q, q) + least,
           0.5 * length(cross(p, q)) + least}};
}

std::vector<BorderSlide> renumbered(std::span<const BorderSlide> slides, const CoarseDisk& coarse,
                                    std::size_t vertices) {
  std::vector<int> number(vertices, -1);
  for (std::size_t v = 0; v < coarse.vertex.size(); ++v)
    number[coarse.vertex[v]] = static_cast<int>(v);
  std::vector<BorderSlide> result(slides.begin(), slides.end());
  for (BorderSlide& slide : result) {
    slide.vertex = number[slide.vertex];
    if (slide.mate >= 0) slide.mate = number[slide.mate];
  }
  return result;
}

bool map_what_is_left(const CollapseHierarchy& mesh, const DiskMesh& disk, std::span<Vec2d> uv,
                      const MapDisk& map, std::span<const BorderSlide> slides) {
  const CoarseDisk coarse = coarse_disk(mesh, disk);
  std::vector<Vec2d> coarse_uv;
  for (const int v : coarse.vertex) coarse_uv.push_back(uv[v]);
  if (!map(coarse.disk, coarse_uv, renumbered(slides, coarse, uv.size()))) return false;
  for (std::size_t v = 0; v < coarse.vertex.size(); ++v) uv[coarse.vertex[v]] = coarse_uv[v];
  return true;
}

}  // namespace

bool map_coarse_to_fine(const DiskMesh& disk, std::span<Vec2d> uv, const MapDisk& map,
                        const CoarseToFineOptions& options) {
  constexpr int triangles_per_border_edge = 8;
  const double mean = mean_area(disk);
  const CollapseOrder order = shortest_first(disk);
  CollapseHierarchy mesh(disk);
  int wanted =
      std::max(options.triangles, triangles_per_border_edge * static_cast<int>(disk.border.size()));
  for (int left = -1;; wanted = left / 4) {
    collapse_in_passes(mesh, order, {.triangles = wanted, .first_cost = mean, .growth = 1.5});
    if (mesh.triangle_count() == left) return false;
    left = mesh.triangle_count();
    if (map_what_is_left(mesh, disk, uv, map, options.slides)) break;
  }
  ReinsertionOptions back{.triangle = [&](const Triangle& t) { return metric(disk, t, mean); },
                          .growth = options.growth,
                          .sweeps = options.sweeps,
                          .slides = options.slides,
                          .progress = options.progress};
  return bring_back(mesh, uv, back) && is_valid_map(disk.triangles, uv);
}

}  // namespace weft
