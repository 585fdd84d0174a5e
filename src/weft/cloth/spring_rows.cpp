#include "weft/cloth/spring_rows.h"

#include <algorithm>

#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

/// Rows whose sums are incomplete, as springs reach two rows down.
constexpr int rows_in_progress = 3;
constexpr int lines_a_worker = rows_in_progress + 1;

}  // namespace

SpringRows::SpringRows(const Cloth& cloth, const ThreadTeam& team)
    : cloth_(cloth),
      kernels_(kernels_for(team.instructions())),
      bends_(cloth.material.bend_springs > 0),
      lines_(3 * lines_a_worker * team.size(), cloth.size) {}

Row3 SpringRows::lines(const Worker& worker, int index) {
  const int first = 3 * (lines_a_worker * worker.rank() + index);
  return {lines_.row(first), lines_.row(first + 1), lines_.row(first + 2)};
}

SpringRow SpringRows::springs(int direction, int row) const {
  const SpringPlane& plane = cloth_.springs[direction];
  const bool damped = cloth_.material.damping > 0;
  return {plane.rest_length.row(row), plane.stiffness.row(row),
          damped ? plane.damping.row(row) : nullptr};
}

void SpringRows::begin(const Motion& motion, Worker& worker) {
  for (int i = 0; i < rows_in_progress; ++i) clear(lines(worker, i), cloth_.size);
  const Range mine = worker.share(cloth_.size);
  for (int r = std::max(0, mine.first - (bends_ ? 2 : 1)); r < mine.first; ++r) {
    add_row(motion, r, worker);
    clear(lines(worker, r % rows_in_progress), cloth_.size);
  }
}

void SpringRows::add_row(const Motion& motion, int row, Worker& worker) {
  const int n = cloth_.size;
  const auto per_step = static_cast<float>(1 / motion.time_step);
  const auto at = [&](int r) {
    return MovingRow{row_of(motion.position, r), row_of(motion.start, r)};
  };
  const auto in_progress = [&](int r) { return lines(worker, r % rows_in_progress); };
  const Row3 out = in_progress(row), scratch = lines(worker, rows_in_progress);
  for (int d = 0; d < (bends_ ? spring_directions : bend_u); ++d) {
    const auto [down, right] = spring_offsets[d];
    if (row + down >= n) continue;
    const int first = std::max(0, -right), last = n - std::max(0, right);
    kernels_.springs({first, last, right, per_step, springs(d, row), at(row), at(row + down)},
                     scratch, out, in_progress(row + down));
  }
}

ConstRow3 SpringRows::row(const Motion& motion, int row, Worker& worker) {
  // The row before has been read; its line buffers are reused for the row two below this one.
  if (row > worker.share(cloth_.size).first)
    clear(lines(worker, (row - 1) % rows_in_progress), cloth_.size);
  add_row(motion, row, worker);
  const Row3 done = lines(worker, row % rows_in_progress);
  return {done.x, done.y, done.z};
}

}  // namespace weft
