#pragma once

#include <array>
#include <vector>

#include "weft/core/vec.h"

namespace weft {

/// Three vertex indices, counter-clockwise seen from outside.
using Triangle = std::array<int, 3>;

/// A triangle mesh as a plain value: nothing is promised of its topology until it was checked
/// (`weft/mesh/repair.h`).
struct TriangleMesh {
  std::vector<Vec3d> positions;     ///< [V], metres
  std::vector<Triangle> triangles;  ///< [F], indices into positions
  /// [F] texture coordinates of each triangle's corners, or empty: not every corner has them. Those
  /// of one vertex may differ between triangles, at a seam of the texture.
  std::vector<std::array<Vec2f, 3>> corner_uv = {};
};

}  // namespace weft
