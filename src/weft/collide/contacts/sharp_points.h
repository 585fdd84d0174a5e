#pragma once

#include <vector>

#include "weft/collide/contacts/body_query.h"

namespace weft {

/// What makes a point of a body too sharp for the samples of a cloth to keep the cloth before it.
struct Sharpness {
  double gap = 0;    ///< at which the inside of a triangle of cloth lies before the point [m]
  double aside = 0;  ///< how far from there its samples are [m]
  double away = 0;   ///< farther from the surface than this nothing holds them [m]
  bool from_inside = false;  ///< the cloth is inside of the closed body
};

/// The points of a body that stand out so much that a triangle's inside may touch them while its
/// samples, on both sides, are away from the surface. Samples that stand for their classes,
/// ascending. All points of an open surface's rim are among them.
/// @param body       placed at `positions`
/// @param positions  [n x n] [m]
std::vector<int> find_sharp_points(const SurfaceGrid& grid, const BodyQuery& body,
                                   const Planes3& positions, const Sharpness& sharpness);

}  // namespace weft
