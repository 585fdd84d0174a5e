#pragma once

#include <vector>

#include "weft/collide/contacts/body_query.h"

namespace weft {

/// Criterion for points of a body too sharp for contacts of a cloth's samples.
struct Sharpness {
  double gap = 0;            ///< of the inside of a cloth's triangle before the point [m]
  double aside = 0;          ///< distance from there to the triangle's samples [m]
  double away = 0;           ///< distance to the surface beyond which samples have no contact [m]
  bool from_inside = false;  ///< the cloth is inside of the closed body
};

/// Finds the sharp points of a body: those that stand out so much that a triangle's inside may
/// touch them while its samples, on both sides, are away from the surface. All points of an open
/// surface's rim are among them.
/// @param body       placed at `positions`
/// @param positions  [n x n] [m]
/// @return representative samples, ascending
std::vector<int> find_sharp_points(const SurfaceGrid& grid, const BodyQuery& body,
                                   const Planes3& positions, const Sharpness& sharpness);

}  // namespace weft
