#include <utility>

#include "weft/cloth/neighbours.h"
#include "weft/cloth/newton/block_multigrid.h"

// The V-cycle: smoothing by lines, and the transfers between levels, from chart to chart.
namespace weft {
namespace {

/// Damping of line relaxation, whose largest eigenvalue is close to 2 for springs.
constexpr float damping = 0.73F;
/// Levels of at most this many samples a side are left to one worker: barriers would cost more.
constexpr int lone_size = 33;
/// Smoothing sweeps on a coarsest level that is not solved directly.
constexpr int coarsest_sweeps = 8;

}  // namespace

void BlockMultigrid::solve_lines(const LineFactor& lines, const PaddedVectors& rhs,
                                 LineFactor::Solve how, PaddedVectors& out,
                                 const Workers& workers) {
  const Range mine = workers.share(lines.blocks());
  for (int b = mine.first; b < mine.last; ++b)
    lines.solve(b, rhs, how, scratch(workers), out, *kernels_);
  workers.barrier();
}

/// Solves all lines. A particle with seam copies is solved for on the line of its first copy; on
/// the lines of its other copies it is fixed.
void BlockMultigrid::relax(BlockLevel& level, Direction direction, bool from_zero,
                           const Workers& workers) {
  const LineFactor& lines = direction == Direction::rows ? level.rows : level.cols;
  solve_lines(lines, from_zero ? level.rhs : level.residual, {damping, !from_zero}, level.value,
              workers);
  if (level.seams.empty()) return;
  level.seams.copy(workers, {&level.value.x, &level.value.y, &level.value.z});
  workers.barrier();
}

void BlockMultigrid::smooth_from_zero(std::size_t index, Direction direction,
                                      const Workers& workers) {
  relax(levels_[index], direction, true, workers);
}

void BlockMultigrid::smooth(std::size_t index, Direction direction, const Loads& contacts,
                            const Workers& workers) {
  residual(index, contacts, workers);
  relax(levels_[index], direction, false, workers);
}

void BlockMultigrid::restrict_residual(BlockLevel& fine, BlockLevel& coarse,
                                       const Workers& workers) {
  if (!fine.seams.empty()) {
    fine.seams.share(workers, {&fine.residual.x, &fine.residual.y, &fine.residual.z});
    workers.barrier();
  }
  const Range mine = workers.share(coarse.size);
  for (int q = mine.first; q < mine.last; ++q)
    for (const ChartRow& part : coarse.layout.rows.row(q)) {
      const Chart &from = fine.layout.charts[part.chart], &to = coarse.layout.charts[part.chart];
      const RowTriple rows = rows_around(fine.residual, from.row + 2 * (q - to.row), from.col);
      kernels_->restrict_row(to.cols, rows, shifted(coarse.rhs.row(q), to.col));
    }
  workers.barrier();
  if (!coarse.short_ends.empty()) {
    coarse.short_ends.fold(workers, coarse.rhs);
    workers.barrier();
  }
  if (coarse.seams.empty()) return;
  coarse.seams.sum(workers, {&coarse.rhs.x, &coarse.rhs.y, &coarse.rhs.z});
  workers.barrier();
}

void BlockMultigrid::prolong(BlockLevel& coarse, std::size_t fine_index, const Workers& workers) {
  BlockLevel& fine = levels_[fine_index];
  if (!coarse.short_ends.empty()) {
    coarse.short_ends.extrapolate(workers, coarse.value);
    workers.barrier();
  }
  const PaddedVectors& values = coarse.value;
  const Range mine = workers.share(fine.size);
  for (int r = mine.first; r < mine.last; ++r) {
    for (const ChartRow& part : fine.layout.rows.row(r)) {
      const Chart &from = coarse.layout.charts[part.chart], &to = fine.layout.charts[part.chart];
      const int row = r - to.row;
      kernels_->prolong_row(to.cols, shifted(values.row(from.row + row / 2), from.col),
                            shifted(values.row(from.row + (row + 1) / 2), from.col),
                            shifted(fine.value.row(r), to.col));
    }
    clear_pins_of_row(fine, r, fine.value);
  }
  workers.barrier();
  if (fine.seams.empty()) return;
  fine.seams.average(workers, {&fine.value.x, &fine.value.y, &fine.value.z});
  workers.barrier();
}

void BlockMultigrid::cycle_coarsest(std::size_t index, const Workers& workers) {
  if (coarsest_.active()) {
    if (workers.alone() || workers.rank() == 0) coarsest_.solve(levels_[index]);
    workers.barrier();
    return;
  }
  smooth_from_zero(index, Direction::rows, workers);
  for (int i = 1; i < coarsest_sweeps; ++i)
    smooth(index, i % 2 == 0 ? Direction::rows : Direction::cols, {}, workers);
}

/// The correction of a level by the next coarser one.
void BlockMultigrid::correct(std::size_t index, const Loads& contacts, const Workers& workers) {
  residual(index, contacts, workers);
  restrict_residual(levels_[index], levels_[index + 1], workers);
  cycle(index + 1, workers);
  prolong(levels_[index + 1], index, workers);
}

void BlockMultigrid::cycle(std::size_t index, const Workers& workers) {
  if (!workers.alone() && levels_[index].size <= lone_size) {
    if (workers.rank() == 0) cycle(index, Workers(workers.worker(), true));
    return workers.barrier();
  }
  if (index + 1 == levels_.size()) return cycle_coarsest(index, workers);
  smooth_from_zero(index, Direction::rows, workers);
  correct(index, {}, workers);
  smooth(index, Direction::cols, {}, workers);
}

void BlockMultigrid::cycle(Worker& worker) {
  smooth_first(worker);
  correct({}, worker);
  smooth_last({}, worker);
}

void BlockMultigrid::smooth_first(Worker& worker) {
  if (levels_.size() > 1) smooth_from_zero(0, Direction::rows, Workers(worker, false));
}

/// A single level has no part that contacts could come between.
void BlockMultigrid::correct(const Loads& contacts, Worker& worker) {
  const Workers all(worker, false);
  if (levels_.size() > 1)
    correct(0, contacts, all);
  else
    cycle_coarsest(0, all);
}

void BlockMultigrid::smooth_last(const Loads& contacts, Worker& worker) {
  if (levels_.size() > 1) smooth(0, Direction::cols, contacts, Workers(worker, false));
}

}  // namespace weft
