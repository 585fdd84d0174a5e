#include "weft/param/trial_map.h"

#include <algorithm>
#include <utility>

#include "weft/core/share_out.h"
#include "weft/param/border_relaxation.h"
#include "weft/param/chords.h"
#include "weft/param/disk_geometry.h"
#include "weft/param/interior_solver.h"
#include "weft/param/stretch_newton.h"
#include "weft/param/weights.h"

namespace weft {
namespace {

int worst_vertex(const DiskGeometry& geometry, std::span<const Vec2d> uv, int first_split) {
  const std::vector<double> sigma = vertex_stretch(geometry.surface, geometry.disk.triangles, uv);
  std::vector<bool> candidate(uv.size(), true);
  for (const int v : geometry.disk.border) candidate[v] = false;
  int worst = -1;
  for (std::size_t v = 0; v < uv.size(); ++v) {
    if (!candidate[v] || geometry.disk.surface_vertex[v] >= first_split) continue;
    if (worst < 0 || sigma[v] > sigma[worst]) worst = static_cast<int>(v);
  }
  return worst < 0 ? -1 : geometry.disk.surface_vertex[worst];
}

std::vector<double> stretch_at(const DiskGeometry& geometry, std::span<const Vec2d> uv, int count) {
  const std::vector<double> sigma = vertex_stretch(geometry.surface, geometry.disk.triangles, uv);
  std::vector<double> largest(count, 0.0);
  for (std::size_t v = 0; v < uv.size(); ++v) {
    const int id = geometry.disk.surface_vertex[v];
    if (id < count) largest[id] = std::max(largest[id], sigma[v]);
  }
  return largest;
}

int surface_vertex_count(const CutDisk& cut) {
  int max = -1;
  for (const int v : cut.disk.surface_vertex) max = std::max(max, v);
  return max + 1;
}

}  // namespace

TrialMap try_map(const CutDisk& cut, int rotation, const TrialOptions& options) {
  const int first_split = surface_vertex_count(cut);
  CutDisk opened = cut;
  const BorderLayout layout = lay_out_border(opened, {options.size, rotation});
  split_at_corners(opened, layout);
  split_chords(opened.disk);
  std::vector<Vec2d> uv(opened.disk.positions.size());
  const std::vector<double> t = border_positions(opened, layout);
  for (std::size_t b = 0; b < t.size(); ++b)
    uv[opened.disk.border[b]] = border_point(options.size, t[b]);

  const DiskGeometry geometry(opened.disk);
  InteriorSolver solver(opened.disk, geometry.edges);
  std::vector<double> weights = symmetric_weights(opened.disk, geometry.edges, geometry.sides);
  PartOfProgress first(options.progress, "cut", 0, 0.3);
  PartOfProgress second(options.progress, "cut", 0.3, 1);
  // Two reweightings: in the first map one nearly collapsed triangle can dominate the stretch.
  const bool valid =
      map_by_reweighting(geometry, solver, weights, uv, {.iterations = 2, .progress = &first});
  TrialMap trial;
  trial.rotation = rotation;
  trial.worst_vertex = worst_vertex(geometry, uv, first_split);
  if (!valid) return trial;
  const std::vector<BorderFreedom> freedoms = border_freedoms(opened, layout, t);
  minimise_by_newton(geometry, uv, {.progress = &second, .freedoms = freedoms});
  trial.energy = geometry.energy(uv);
  trial.stretch_at = stretch_at(geometry, uv, first_split);
  return trial;
}

TrialMap try_rotations(const CutDisk& cut, std::span<const int> rotations,
                       const TrialOptions& options) {
  std::vector<TrialMap> made(rotations.size());
  share_out(static_cast<int>(rotations.size()), options.threads, options.progress, "cut",
            [&](int k, Progress* progress) {
              made[k] = try_map(cut, rotations[k], {.size = options.size, .progress = progress});
            });
  return std::move(
      *std::min_element(made.begin(), made.end(),
                        [](const TrialMap& a, const TrialMap& b) { return a.energy < b.energy; }));
}

}  // namespace weft
