#pragma once

#include "weft/geometry_image.h"
#include "weft/grid.h"

namespace weft {

/// Whether the borders of two panels touch elsewhere than where they are sewn together: side by
/// side in one plane they would overlap after a step.
/// @param sewn  the panels with their seams closed  @param placed  where they lie [n x n] [m]
bool panels_touch(const BorderMates& sewn, int a, int b, const Planes3& placed);

}  // namespace weft
