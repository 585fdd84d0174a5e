#include "weft/param/interior_map.h"

#include "weft/param/coarse_to_fine.h"
#include "weft/param/disk_geometry.h"
#include "weft/param/interior_solver.h"
#include "weft/param/progressive_embedding.h"
#include "weft/param/stretch_newton.h"
#include "weft/param/weights.h"

namespace weft {
namespace {

constexpr int max_cures = 6;

struct Task {
  const DiskGeometry& geometry;
  InteriorSolver& solver;
  std::span<Vec2d> uv;
  const InteriorOptions& options;
};

/// Floater's map. Where rounding makes it invalid, the weights are divided by the stretch of their
/// ends, which spreads the regions where the map has collapsed.
bool map_by_floater(const Task& task) {
  const auto& [geometry, solver, uv, options] = task;
  std::vector<double> weights =
      shape_preserving_weights(geometry.disk, geometry.edges, geometry.sides);
  for (int cure = 0; cure <= max_cures; ++cure) {
    update(options.progress, "map", 0.1);
    if (cure > 0) reweight(geometry, uv, weights);
    if (!solver.solve_general(weights, uv)) return false;
    if (is_valid_map(geometry.disk.triangles, uv)) return true;
  }
  return false;
}

NewtonOptions newton(const StretchOptions& stretch, std::span<const BorderFreedom> freedoms,
                     Progress* progress) {
  return {
      .steps = stretch.newton_steps, .min_gain = 1e-4, .progress = progress, .freedoms = freedoms};
}

/// Reweighting of positive weights, then Newton steps.
bool map_by_weights(const Task& task, const StretchOptions& stretch) {
  const auto& [geometry, solver, uv, options] = task;
  PartOfProgress first(options.progress, "map", 0, 0.3);
  PartOfProgress second(options.progress, "map", 0.3, 1);
  std::vector<double> weights = symmetric_weights(geometry.disk, geometry.edges, geometry.sides);
  ReweightingOptions reweighting{
      .iterations = stretch.iterations, .cures = max_cures, .progress = &first};
  // Newton steps gain more than the last reweightings would.
  if (stretch.newton_steps > 0) reweighting.min_gain = 0.01;
  bool found = map_by_reweighting(geometry, solver, weights, uv, reweighting);
  if (!found) {
    // Equal weights ignore the shapes of triangles, slivers included.
    weights.assign(weights.size(), 1.0);
    found = map_by_reweighting(geometry, solver, weights, uv, reweighting);
  }
  if (found && stretch.newton_steps > 0)
    minimise_by_newton(geometry, uv, newton(stretch, options.freedoms, &second));
  return found;
}

bool map_with_least_stretch(const DiskMesh& disk, std::span<Vec2d> uv,
                            const StretchOptions& stretch, const InteriorOptions& options) {
  PartOfProgress first(options.progress, "map", 0.1, 0.4);
  PartOfProgress second(options.progress, "map", 0.4, 1);
  const MapDisk by_weights = [&](const DiskMesh& part, std::span<Vec2d> part_uv,
                                 std::span<const BorderFreedom> freedoms) {
    const DiskGeometry geometry(part);
    InteriorSolver solver(part, geometry.edges);
    return map_by_weights({geometry, solver, part_uv, {.freedoms = freedoms, .progress = &first}},
                          stretch);
  };
  const MapDisk by_embedding = [&](const DiskMesh& part, std::span<Vec2d> part_uv,
                                   std::span<const BorderFreedom> freedoms) {
    if (!embed_progressively(part, part_uv, &first)) return false;
    minimise_by_newton(DiskGeometry(part), part_uv, newton(stretch, freedoms, &first));
    return true;
  };
  if (stretch.newton_steps == 0 && by_weights(disk, uv, {})) return true;
  const CoarseToFineOptions refinement{
      .freedoms = options.freedoms, .threads = options.threads, .progress = &second};
  return map_coarse_to_fine(disk, uv, by_weights, refinement) ||
         map_coarse_to_fine(disk, uv, by_embedding, refinement) ||
         embed_progressively(disk, uv, &second);
}

}  // namespace

bool map_interior(const DiskMesh& disk, std::span<Vec2d> uv, const Parameterizer& parameterizer,
                  const InteriorOptions& options) {
  update(options.progress, "map", 0.1);
  if (const auto* stretch = std::get_if<StretchOptions>(&parameterizer))
    return map_with_least_stretch(disk, uv, *stretch, options);
  const DiskGeometry geometry(disk);
  InteriorSolver solver(disk, geometry.edges);
  // A valid map that is not Floater's is better than none.
  return map_by_floater({geometry, solver, uv, options}) ||
         map_with_least_stretch(disk, uv, {},
                                {.threads = options.threads, .progress = options.progress});
}

}  // namespace weft
