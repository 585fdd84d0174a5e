#pragma once

#include <algorithm>

#include "weft/cloth/neighbours.h"

namespace weft {

/// The stiffness of springs whose ratio to the masses they join is the same everywhere: `per_mass`
/// times the harmonic mean of both masses. On equal particles that is one stiffness for all, as the
/// paper has it; on uneven cells it keeps h^2 k / m, and with it stability, alike for small and
/// large particles. Springs along the border have half: on a seam both mates hold them, on an edge
/// they stand for half a strip.
/// @param mass_at  mass of the particle at (row, col) [kg]
/// @param out      [n x n] the spring from (r, c) on [N/m]
template <class MassAt, class T>
void mass_springs(SpringOffset offset, double per_mass, const MassAt& mass_at, Grid<T>& out) {
  const int n = out.rows();
  const auto [down, right] = offset;
  for (int r = 0; r + down < n; ++r)
    for (int c = std::max(0, -right); c + std::max(0, right) < n; ++c) {
      const double a = mass_at(r, c), b = mass_at(r + down, c + right);
      const bool along =
          (down == 0 && (r == 0 || r == n - 1)) || (right == 0 && (c == 0 || c == n - 1));
      out(r, c) = static_cast<T>((along ? 0.5 : 1.0) * per_mass * 2 * a * b / (a + b));
    }
}

}  // namespace weft
