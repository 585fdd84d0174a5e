#pragma once

#include "weft/collide/pairs/extent_levels.h"

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

/// The same for all windows of 2 x 2 cells that begin in a row of cells but the last, at once.
/// @param along_rows, along_columns  extents of a cloth's edges, finest level
/// @param out  [cells - 1] 1 where the window is certainly unfolded, else 0
void find_unfolded_windows(const ExtentLevels& along_rows, const ExtentLevels& along_columns,
                           int row, float slack, float* out);

}  // namespace weft
