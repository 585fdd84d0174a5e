#pragma once

#include <span>
#include <vector>

#include "weft/param/disk_geometry.h"
#include "weft/param/interior_solver.h"
#include "weft/progress.h"

namespace weft {

/// Stretch minimisation by reweighting [yoshizawa04], in the symmetric form: every weight w_ij is
/// divided by the stretch of both its ends, w_ij / (sigma_i sigma_j), and the system solved again.
/// The source divides by the stretch of one end only, which takes an unsymmetric factorization each
/// time. Weights stay positive, so every iterate is an embedding as far as doubles can tell.
struct ReweightingOptions {
  int iterations = 10;     ///< at most, once a valid map is there
  int cures = 6;           ///< how often a map that is not valid is reweighted before giving up
  double min_gain = 1e-3;  ///< relative fall of the stretch below which the iteration ends
  Progress* progress = nullptr;  ///< told of every iteration
};

/// @param weights  [3F] symmetric and positive to start from; reweighted in place
/// @param uv       [D] border given; on success the valid iterate of least L2 stretch
/// @return whether a valid map was found; if not, uv is the last iterate
bool map_by_reweighting(const DiskGeometry& geometry, InteriorSolver& solver,
                        std::vector<double>& weights, std::span<Vec2d> uv,
                        const ReweightingOptions& options);

/// Divides every weight by the stretch of both its ends in the given map.
void reweight(const DiskGeometry& geometry, std::span<const Vec2d> uv, std::span<double> weights);

}  // namespace weft
