#pragma once

#include <array>
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

/// What the interior maps of one disk have in common, computed once.
struct DiskGeometry {
  /// Keeps a reference to the disk, which must outlive it.
  explicit DiskGeometry(const DiskMesh& mesh);

  const DiskMesh& disk;
  HalfEdges edges;
  std::vector<std::array<double, 3>> sides;  ///< [F] floored lengths
  std::vector<SurfaceTriangle> surface;      ///< [F] the metric as it is

  std::vector<double> curvature_weight;  ///< [F] of the quartic term of the energy
  std::vector<double> inverse;           ///< [F] of the inverse term, see inverse_weight

  /// Square stretch of a map that keeps areas, of the size of this one: a constant of the disk and
  /// the square.
  [[nodiscard]] double mean_square_stretch(std::span<const Vec2d> uv) const;
  /// What the Newton steps lower: the sum over all triangles of area * (m + q m^2 / 2), m their
  /// mean square stretch and q their curvature weight in units of mean_square_stretch, and of their
  /// inverse stretch. For a valid map.
  [[nodiscard]] double energy(std::span<const Vec2d> uv) const;
  [[nodiscard]] double stretch_l2(std::span<const Vec2d> uv) const;
};

/// Whether every triangle turns left, by exact arithmetic on the doubles as they are.
bool is_valid_map(std::span<const Triangle> triangles, std::span<const Vec2d> uv);

}  // namespace weft
