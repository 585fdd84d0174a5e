#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/mesh.h"

namespace weft {

/// Edge lengths of a mesh, raised by one small amount where it takes that for every triangle to be
/// a true one: each two sides longer than the third by at least 1e-5 of the mean edge (intrinsic
/// mollification, [sharp20]). Zero-area triangles and coincident points then have finite angles and
/// weights. A mesh without slivers keeps its lengths to the last bit.
/// @return [F][3] length of the side from corner k to the next [m], all > 0
std::vector<std::array<double, 3>> floored_lengths(std::span<const Vec3d> positions,
                                                   std::span<const Triangle> triangles);

/// Tangents of the half angles at the corners of a triangle given by its sides.
/// @param sides  length of the side from corner k to the next
/// @return at corner k, in (0, infinity)
std::array<double, 3> half_angle_tangents(const std::array<double, 3>& sides);

}  // namespace weft
