#pragma once

#include "weft/cloth/multigrid/filter_level.h"

namespace weft {

// What a filter level does a row at a time. A sample gets its own part; nothing but the row itself
// is written.

/// Three lines of n values, one a coordinate.
struct Line3 {
  float *x, *y, *z;
};

/// line = b - A x.
/// @param x      [n x n] [m]
/// @param right  [n x n] own part of b [N]
void residual_row(const FilterLevel& level, const Planes3& x, const Planes3& right, int row,
                  Line3 line);

}  // namespace weft
