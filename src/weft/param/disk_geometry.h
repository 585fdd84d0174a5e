#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/cut/disk_mesh.h"
#include "weft/mesh/stretch.h"
#include "weft/mesh/topology.h"

namespace weft {

/// Edge lengths of a mesh after intrinsic mollification [sharp20]: all are raised by one small
/// amount, so that in every triangle two sides together exceed the third by at least 1e-5 of the
/// mean edge. Zero-area triangles and coincident points then have finite angles and weights. A mesh
/// without slivers keeps its lengths to the last bit.
/// @return [F][3] length of the side from corner k to the next [m], all > 0
std::vector<std::array<double, 3>> floored_lengths(std::span<const Vec3d> positions,
                                                   std::span<const Triangle> triangles);

/// Tangents of the half angles at the corners of a triangle given by its sides.
/// @param sides  length of the side from corner k to the next
/// @return at corner k, in (0, infinity)
std::array<double, 3> half_angle_tangents(const std::array<double, 3>& sides);

/// Curvature weight q of each triangle: the weight of the quartic stretch term in the energy
/// area * (m + q m^2 / 2), with m the mean square stretch of the triangle relative to that of the
/// map.
///
/// Samples h apart miss a surface of curvature k by about k h^2 / 8, so the mean square error grows
/// with k^2 m^2. The weight is the sum of a small constant, which keeps small protruding parts from
/// getting too few samples, and a bounded share proportional to k^2 relative to its mean. Curvature
/// comes from the angles between neighbouring triangles, smoothed over a few of them.
/// @return [F] > 0
std::vector<double> curvature_weights(const DiskMesh& disk, const HalfEdges& edges,
                                      std::span<const SurfaceTriangle> surface);

/// Quantities shared by all interior maps of one disk, computed once.
struct DiskGeometry {
  /// Keeps a reference to the disk, which must outlive it.
  explicit DiskGeometry(const DiskMesh& mesh);

  const DiskMesh& disk;
  HalfEdges edges;
  std::vector<std::array<double, 3>> sides;  ///< [F] floored lengths
  std::vector<SurfaceTriangle> surface;      ///< [F] the metric, not floored

  std::vector<double> curvature_weight;  ///< [F] weight of the quartic term of the energy
  std::vector<double> inverse;           ///< [F] weight of the inverse term, see inverse_weight

  /// Mean square stretch of an area-preserving map with the plane area of `uv`: surface area /
  /// plane area, a constant of the disk and the square.
  [[nodiscard]] double mean_square_stretch(std::span<const Vec2d> uv) const;
  /// The energy that Newton steps minimise, for a valid map: the sum over all triangles of
  /// area * (m + q m^2 / 2), m their mean square stretch and q their curvature weight in units of
  /// mean_square_stretch, plus the inverse term (see inverse_weight).
  [[nodiscard]] double energy(std::span<const Vec2d> uv) const;
  [[nodiscard]] double stretch_l2(std::span<const Vec2d> uv) const;
};

/// Whether every triangle is positively oriented, by exact arithmetic on the doubles.
bool is_valid_map(std::span<const Triangle> triangles, std::span<const Vec2d> uv);

}  // namespace weft
