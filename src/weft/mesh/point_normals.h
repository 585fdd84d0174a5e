#pragma once

#include <span>
#include <vector>

#include "weft/mesh.h"

namespace weft {

/// Unit normals of the points of a mesh: the sum of the vector areas of the triangles around each.
/// (0, 1, 0) where there is no area.
/// @param points     [V]
/// @param triangles  indices into points
std::vector<Vec3f> point_normals(std::span<const Vec3f> points,
                                 std::span<const Triangle> triangles);

}  // namespace weft
