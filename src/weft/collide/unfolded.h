#pragma once

#include "weft/collide/node_levels.h"

namespace weft {

/// Whether a rectangle of cells certainly does not meet itself, for the extents that its edges
/// along rows and along columns keep to.
///
/// Every triangle of a grid, whichever its diagonal, has one edge of each kind, so its gradient
/// lies in these boxes, at all times of a step, since edges move on straight lines. Projected by
/// the basis that is dual to the boxes' centres it becomes a 2 x 2 matrix near the identity. If the
/// symmetric part of all such matrices is positive, (f(q) - f(p)) . (q - p) > 0 for every two
/// points p and q of the rectangle, which is convex: no two points of the surface coincide. Unlike
/// cones of normals this needs no test of contours.
/// @param slack  by which any edge may yet differ [m]
bool certainly_unfolded(const Box3f& along_rows, const Box3f& along_columns, float slack);

}  // namespace weft
