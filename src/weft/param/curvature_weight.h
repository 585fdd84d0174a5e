#pragma once

#include <span>
#include <vector>

#include "weft/cut/disk_mesh.h"
#include "weft/mesh/stretch.h"
#include "weft/mesh/topology.h"

namespace weft {

/// How much each triangle's stretch is to count beyond its square, in the energy
/// area * (m + q m^2 / 2) with m the mean square stretch of the triangle over that of the map.
///
/// Samples h apart miss a surface of curvature k by about k h^2 / 8, so the mean square of what
/// they miss goes with k^2 m^2: the weight is a small constant, which keeps small far-off parts
/// from being starved of samples, and a share in proportion to k^2 (from the angles between
/// neighbouring triangles, spread over a few of them), in units of its mean and bounded.
/// @return [F] > 0
std::vector<double> curvature_weights(const DiskMesh& disk, const HalfEdges& edges,
                                      std::span<const SurfaceTriangle> surface);

}  // namespace weft
