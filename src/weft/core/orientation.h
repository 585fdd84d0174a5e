#pragma once

#include "weft/vec.h"

namespace weft {

// Signs of determinants of the doubles as they are, without rounding error: a floating filter
// decides the clear cases (error bounds of [shewchuk97]), exact arithmetic the rest. @pre
// coordinates below 1e100

/// +1 when a, b, c turn left (counter-clockwise), -1 when right, 0 when exactly on one line.
int orientation(Vec2d a, Vec2d b, Vec2d c);

/// +1 when d lies on the side of the plane through a, b, c from which they turn counter-clockwise,
/// -1 on the other side, 0 when the four are exactly in one plane.
int orientation(Vec3d a, Vec3d b, Vec3d c, Vec3d d);

}  // namespace weft
