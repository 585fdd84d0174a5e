#pragma once

#include <algorithm>

#include "weft/cloth/cloth.h"

namespace weft {

/// Calls visit(row, col, other_row, other_col) for the springs of a plane that join two particles.
template <class Visit>
void for_each_spring(const BorderMates& mates, const SpringPlane& plane, const Visit& visit) {
  const int n = mates.size();
  for (int r = 0; r + plane.down < n; ++r)
    for (int c = std::max(0, -plane.right); c + std::max(0, plane.right) < n; ++c) {
      const int r2 = r + plane.down, c2 = c + plane.right;
      if (mates.representative(r * n + c) != mates.representative(r2 * n + c2)) visit(r, c, r2, c2);
    }
}

/// The stretch and shear springs with an end on the border, each once. Needs the cloth's size,
/// mates and rest lengths.
std::vector<BorderSpring> find_border_springs(const Cloth& cloth);

}  // namespace weft
