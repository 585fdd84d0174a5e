#pragma once

#include "weft/core/vec.h"

namespace weft {

/// +1 when a, b, c turn left (counter-clockwise), -1 when right, 0 when exactly on one line: the
/// sign of the determinant of the doubles as they are, without rounding error. A floating filter
/// decides the clear cases (error bound of Shewchuk 1997), exact arithmetic the rest.
int orientation(Vec2d a, Vec2d b, Vec2d c);

}  // namespace weft
