#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/cut/disk_mesh.h"
#include "weft/mesh/topology.h"

namespace weft {

// A weight belongs to a half-edge: weight[h] pulls the vertex that h leaves towards the one it
// points at. Every interior vertex is then the weighted mean of its neighbours, which for positive
// weights and a convex border is an embedding [tutte63, floater97]. All weights here are finite and
// > 0; those of half-edges that leave the border are meaningless.

/// Floater's shape-preserving weights: the one-ring is laid out by a geodesic polar map, and each
/// neighbour contributes the barycentric coordinates of the centre in the triangle it spans
/// [floater97]. Reproduces flat convex meshes. The weights of one vertex sum to 1; not symmetric.
/// @param sides  [F] floored lengths (weft/param/edge_lengths.h)
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

}  // namespace weft
