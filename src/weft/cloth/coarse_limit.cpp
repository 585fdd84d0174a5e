#include "weft/cloth/coarse_limit.h"

#include <algorithm>

#include "weft/cloth/border_springs.h"
#include "weft/cloth/mates.h"
#include "weft/cloth/mip_levels.h"
#include "weft/cloth/neighbours.h"
#include "weft/cloth/strain_limit.h"

namespace weft {
namespace {

constexpr int least_level_size = 3;

/// The bounds of springs two samples long: the sum of both.
SpringPlane joined_springs(const SpringPlane& fine, int n) {
  SpringPlane plane{fine.down, fine.right, Grid<float>(n, n, 1), {}, {}};
  for (int r = 0; r + fine.down < n; ++r)
    for (int c = std::max(0, -fine.right); c + std::max(0, fine.right) < n; ++c)
      plane.rest_length(r, c) = fine.rest_length(2 * r, 2 * c) +
                                fine.rest_length(2 * r + fine.down, 2 * c + fine.right);
  return plane;
}

void restrict_masses(const Cloth& fine, Cloth& coarse) {
  const int n = coarse.size;
  coarse.mass = coarse.inverse_mass = coarse.counted = Grid<float>(n, n, 1);
  for (int index = 0; index < coarse.mates.class_count(); ++index)
    for (const int s : coarse.mates.mates(index).subspan(1)) coarse.counted(s / n, s % n) = 0;
  std::vector<float> line(static_cast<std::size_t>(fine.size));
  for (int r = 0; r < n; ++r)
    restrict_plane_row(fine.mass, &fine.counted, r, line.data(), coarse.mass.row(r));
  sum_over_mates(coarse.mates, {&coarse.mass});
}

/// Adds the interpolation of a coarser level's corrections to a row, times `scale` where it moves.
void add_correction(const ClothState& coarse, const Grid<float>& moves, int row, Planes3& out) {
  const Row3 to = row_of(out, row);
  add_interpolated_row(coarse.velocity.x, row, moves.row(row), to.x);
  add_interpolated_row(coarse.velocity.y, row, moves.row(row), to.y);
  add_interpolated_row(coarse.velocity.z, row, moves.row(row), to.z);
}

}  // namespace
}  // namespace weft
