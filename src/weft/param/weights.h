#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/cut/disk_mesh.h"
#include "weft/mesh/topology.h"
#include "weft/param/disk_geometry.h"
#include "weft/param/interior_solver.h"
#include "weft/progress.h"

namespace weft {

// A weight belongs to a half-edge: weight[h] pulls the vertex that h leaves towards the one it
// points at. Every interior vertex is then the weighted mean of its neighbours, which for positive
// weights and a convex border is an embedding [tutte63, floater97]. All weights here are finite and
// > 0; those of half-edges that leave the border are meaningless.

/// Floater's shape-preserving weights: the one-ring is laid out by a geodesic polar map, and each
/// neighbour contributes the barycentric coordinates of the centre in the triangle it spans
/// [floater97]. Reproduces flat convex meshes. The weights of one vertex sum to 1; not symmetric.
/// @param sides  [F] floored lengths (weft/param/disk_geometry.h)
/// @return [3F]
std::vector<double> shape_preserving_weights(const DiskMesh& disk, const HalfEdges& edges,
                                             std::span<const std::array<double, 3>> sides);

/// Mean value weights, (tan(a / 2) + tan(b / 2)) / length with the angles a, b beside the edge at
/// the vertex [floater03]. Reproduces flat convex meshes; not symmetric. @return [3F]
std::vector<double> mean_value_weights(const DiskMesh& disk, const HalfEdges& edges,
                                       std::span<const std::array<double, 3>> sides);

/// The mean of the mean value weights of both directions: symmetric (weight[h] == weight[twin])
/// and, unlike cotangents, positive. The start of the stretch minimisation, so that each of its
/// systems is symmetric positive definite with one pattern. @return [3F]
std::vector<double> symmetric_weights(const DiskMesh& disk, const HalfEdges& edges,
                                      std::span<const std::array<double, 3>> sides);

/// Stretch minimisation by reweighting [yoshizawa04], in a symmetric form: every weight w_ij is
/// divided by the stretch of both its ends, w_ij / (sigma_i sigma_j), and the system solved again.
/// The original divides by the stretch of one end only, which needs an unsymmetric factorization
/// each time. Weights stay positive, so every iterate is an embedding up to rounding.
struct ReweightingOptions {
  int iterations = 10;     ///< maximum, counted from the first valid map
  int cures = 6;           ///< maximum number of reweightings of a map that is not valid
  double min_gain = 1e-3;  ///< relative decrease of the stretch below which the iteration ends
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
