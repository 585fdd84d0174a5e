#pragma once

#include <algorithm>

#include "weft/cloth/cloth.h"

namespace weft {

/// Whether a sample lies on the border of its chart.
inline bool on_border(const BorderMates& mates, int row, int col) {
  return !mates.has_cell(row, col) || !mates.has_cell(row - 1, col) ||
         !mates.has_cell(row, col - 1) || !mates.has_cell(row - 1, col - 1);
}

/// Whether a spring of a chart along its rows or columns lies on its border.
inline bool along_border(const BorderMates& mates, SpringDirection direction, int row, int col) {
  const bool along_row = direction == stretch_u || direction == bend_u;
  return mates.has_cell(row, col) !=
         mates.has_cell(row - (along_row ? 1 : 0), col - (along_row ? 0 : 1));
}

/// Calls visit(row, col, other_row, other_col) for the springs of a plane that join two particles.
template <class Visit>
void for_each_spring(const BorderMates& mates, const SpringPlane& plane, const Visit& visit) {
  const int n = mates.size();
  for (int r = 0; r + plane.down < n; ++r)
    for (int c = std::max(0, -plane.right); c + std::max(0, plane.right) < n; ++c) {
      const int r2 = r + plane.down, c2 = c + plane.right;
      const int from = r * n + c, to = r2 * n + c2;
      if (mates.same_chart(from, to) && mates.representative(from) != mates.representative(to))
        visit(r, c, r2, c2);
    }
}

/// The stretch and shear springs with an end on the border, each once. Needs the cloth's size,
/// mates and rest lengths.
std::vector<BorderSpring> find_border_springs(const Cloth& cloth);

}  // namespace weft
