#include "weft/param/square_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "weft/core/orientation.h"
#include "weft/error.h"
#include "weft/mesh/stretch.h"
#include "weft/param/border_layout.h"
#include "weft/param/chords.h"
#include "weft/param/interior_map.h"
#include "weft/param/proxy.h"
#include "weft/param/trial_map.h"

namespace weft {

namespace {

/// Positions with the border vertices placed and all others at the origin.
std::vector<Vec2d> place_border(const CutDisk& cut, int size, std::span<const double> t) {
  std::vector<Vec2d> uv(cut.disk.positions.size());
  for (std::size_t b = 0; b < t.size(); ++b) uv[cut.disk.border[b]] = border_point(size, t[b]);
  return uv;
}

}  // namespace

MappedDisk map_to_square(CutDisk cut, const MapOptions& options) {
  MappedDisk mapped{
      .cut = std::move(cut), .layout = {}, .map = {}, .quality = {}, .parameterizer = "stretch"};
  if (std::holds_alternative<FloaterOptions>(options.parameterizer))
    mapped.parameterizer = "floater";
  update(options.progress, "map", 0.0);
  const LayoutOptions layout{
      options.size, choose_rotation(mapped.cut, options.size, options.rotations, options.threads)};
  mapped.layout = lay_out_border(mapped.cut, layout);
  split_at_corners(mapped.cut, mapped.layout);
  split_chords(mapped.cut.disk);

  mapped.map.size = options.size;
  const std::vector<double> t = border_positions(mapped.cut, mapped.layout);
  mapped.map.uv = place_border(mapped.cut, options.size, t);
  const std::vector<BorderFreedom> freedoms = border_freedoms(mapped.cut, mapped.layout, t);
  const bool found = map_interior(
      mapped.cut.disk, mapped.map.uv, options.parameterizer,
      {.freedoms = freedoms, .threads = options.threads, .progress = options.progress});
  mapped.quality = measure_map(mapped.cut.disk, mapped.map);
  if (!found)
    throw TopologyError(options.name,
                        fmt::format("no valid map was found: {} triangles flipped, {} without area",
                                    mapped.quality.flipped, mapped.quality.degenerate),
                        "a mesh with fewer or better shaped triangles");
  update(options.progress, "map", 1.0);
  return mapped;
}

MapQuality measure_map(const DiskMesh& disk, const SquareMap& map) {
  MapQuality quality;
  for (const auto& [a, b, c] : disk.triangles) {
    const int sign = orientation(map.uv[a], map.uv[b], map.uv[c]);
    quality.flipped += sign < 0 ? 1 : 0;
    quality.degenerate += sign == 0 ? 1 : 0;
  }
  const Stretch stretch =
      measure_stretch(surface_triangles(disk.positions, disk.triangles), disk.triangles, map.uv);
  quality.stretch_l2 = stretch.l2;
  quality.stretch_linf = stretch.linf;
  return quality;
}

namespace {

constexpr int max_triangles = 2000;

/// The surface before it was cut open, and the cut on it.
struct Surface {
  TriangleMesh mesh;
  Cut cut;
};

Surface closed(const CutDisk& cut) {
  const DiskMesh& disk = cut.disk;
  Surface surface;
  for (std::size_t v = 0; v < disk.positions.size(); ++v) {
    const auto id = static_cast<std::size_t>(disk.surface_vertex[v]);
    if (id >= surface.mesh.positions.size()) surface.mesh.positions.resize(id + 1);
    surface.mesh.positions[id] = disk.positions[v];
  }
  surface.mesh.triangles = disk.triangles;
  for (Triangle& t : surface.mesh.triangles)
    for (int& corner : t) corner = disk.surface_vertex[corner];
  const std::size_t size = disk.border.size();
  for (int p = 0; p < static_cast<int>(cut.paths.size()); ++p) {
    if (cut.paths[p].mate <= p) continue;
    for (int j = 0; j < cut.paths[p].edges; ++j) {
      const std::size_t first = static_cast<std::size_t>(cut.paths[p].first) + j;
      const int a = disk.surface_vertex[disk.border[first % size]];
      const int b = disk.surface_vertex[disk.border[(first + 1) % size]];
      surface.cut.edges.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  std::sort(surface.cut.edges.begin(), surface.cut.edges.end());
  return surface;
}

/// Distance between two positions along the border, the shorter way around.
double apart(double a, double b, double around) {
  const double distance = std::fmod(std::abs(a - b), around);
  return std::min(distance, around - distance);
}

/// Transfers a border rotation from a coarsened disk to the fine one: to the rotation that puts the
/// nodes nearest to those of the coarse disk.
struct Transfer {
  const CutDisk& fine;
  const CutDisk& coarse;
  const std::vector<int>& source_vertex;
  int size;

  [[nodiscard]] int rotation(int of_coarse, int step) const {
    const double around = 4.0 * (size - 1);
    const std::vector<double> t = border_positions(fine, lay_out_border(fine, {size, 0}));
    const std::vector<int> wanted = lay_out_border(coarse, {size, of_coarse}).first;
    double min = std::numeric_limits<double>::infinity();
    double best = 0;
    for (const double candidate : places_of(0, t)) {
      const double shift = wanted[0] - candidate;
      double sum = 0;
      for (std::size_t p = 0; p < wanted.size(); ++p) {
        double nearest = around;
        for (const double place : places_of(p, t))
          nearest = std::min(nearest, apart(place + shift, wanted[p], around));
        sum += nearest;
      }
      if (sum >= min) continue;
      min = sum;
      best = shift;
    }
    return static_cast<int>(std::round(best / step)) * step;
  }

  /// Border positions on the fine disk of a coarse path's first node, one for each of its seam
  /// copies.
  [[nodiscard]] std::vector<double> places_of(std::size_t path,
                                              const std::vector<double>& t) const {
    const int node = coarse.disk.border[coarse.paths[path].first];
    const int surface_vertex = source_vertex[coarse.disk.surface_vertex[node]];
    std::vector<double> places;
    for (std::size_t b = 0; b < t.size(); ++b)
      if (fine.disk.surface_vertex[fine.disk.border[b]] == surface_vertex) places.push_back(t[b]);
    return places;
  }
};

int best_rotation(const CutDisk& cut, int count, int step, const TrialOptions& options) {
  std::vector<int> rotations;
  for (int k = 0; k < count; ++k) rotations.push_back(2 * k * step);
  const TrialMap best = try_rotations(cut, rotations, options);
  const std::vector<int> near = {best.rotation - step, best.rotation + step};
  const TrialMap refined = try_rotations(cut, near, options);
  return refined.energy < best.energy ? refined.rotation : best.rotation;
}

}  // namespace

int choose_rotation(const CutDisk& cut, int size, int count, int threads) {
  count = std::min(count, (size - 1) / 2);
  if (count <= 1) return 0;
  const int step = (size - 1) / (2 * count);
  const TrialOptions options{.size = size, .threads = threads};
  if (static_cast<int>(cut.disk.triangles.size()) <= max_triangles)
    return best_rotation(cut, count, step, options);
  const Surface surface = closed(cut);
  const Proxy proxy = coarsen(surface.mesh, surface.cut, max_triangles);
  const CutDisk coarse = cut_open(proxy.mesh, proxy.cut);
  const Transfer transfer{cut, coarse, proxy.source_vertex, size};
  return transfer.rotation(best_rotation(coarse, count, step, options), step);
}

}  // namespace weft
