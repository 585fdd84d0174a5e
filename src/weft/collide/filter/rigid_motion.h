#pragma once

#include <array>
#include <optional>

#include "weft/grid.h"

namespace weft {

/// A turn and a shift.
struct RigidMotion {
  std::array<Vec3d, 3> rows;  ///< of the rotation
  Vec3d shift;                ///< [m]
  [[nodiscard]] Vec3d operator()(Vec3d at) const {
    return Vec3d{dot(rows[0], at), dot(rows[1], at), dot(rows[2], at)} + shift;
  }
};

/// The rigid motion that takes a surface from start to end, or nothing where none takes all its
/// samples there but for rounding. @param start, end  of one size [m]
[[nodiscard]] std::optional<RigidMotion> rigid_motion(const Planes3& start, const Planes3& end);

}  // namespace weft
