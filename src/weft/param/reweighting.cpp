#include "weft/param/reweighting.h"

#include <algorithm>
#include <limits>

namespace weft {

void reweight(const DiskGeometry& geometry, std::span<const Vec2d> uv, std::span<double> weights) {
  const std::vector<double> sigma = vertex_stretch(geometry.surface, geometry.disk.triangles, uv);
  for (int h = 0; h < static_cast<int>(weights.size()); ++h)
    weights[h] /= sigma[from_vertex(geometry.disk.triangles, h)] *
                  sigma[to_vertex(geometry.disk.triangles, h)];
}

bool map_by_reweighting(const DiskGeometry& geometry, InteriorSolver& solver,
                        std::vector<double>& weights, std::span<Vec2d> uv,
                        const ReweightingOptions& options) {
  std::vector<Vec2d> best;
  double best_stretch = std::numeric_limits<double>::infinity();
  int rounds_with_map = 0;
  for (int round = 0; rounds_with_map <= options.iterations; ++round) {
    if (best.empty() && round > options.cures) break;
    update(options.progress, "map", std::min(1.0, round / (options.iterations + 1.0)));
    if (!solver.factorize_symmetric(weights)) break;
    solver.solve_symmetric(uv);
    const double stretch = geometry.stretch_l2(uv);
    const bool enough = stretch > best_stretch * (1 - options.min_gain);
    if (stretch < best_stretch && is_valid_map(geometry.disk.triangles, uv)) {
      best_stretch = stretch;
      best.assign(uv.begin(), uv.end());
    }
    if (!best.empty()) ++rounds_with_map;
    if (enough) break;
    reweight(geometry, uv, weights);
  }
  if (best.empty()) return false;
  std::copy(best.begin(), best.end(), uv.begin());
  return true;
}

}  // namespace weft
