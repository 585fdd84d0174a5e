#include "weft/cloth/baselines/multigrid/multigrid_preconditioner.h"

#include <algorithm>
#include <array>
#include <utility>

#include "weft/cloth/mates.h"
#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

/// Damping factors of the Jacobi sweeps. The upper part of the spectrum of D^-1 A reaches to about
/// 1.9 (Gershgorin's bound without what shear takes off it); what is below 0.3 is left to the next
/// level, even beside points where many corners meet.
std::vector<float> sweep_factors(int sweeps) {
  if (sweeps == 1) return {0.85F};
  constexpr float middle = 0.5F * (1.9F + 0.3F), half = 0.5F * (1.9F - 0.3F), root = 0.70710678F;
  return {1 / (middle + half * root), 1 / (middle - half * root)};
}
/// Sweeps on a coarsest level that is too large to be factored.
constexpr int coarsest_sweeps = 24;
/// Levels of at most this many samples a side are left to one worker: barriers would cost more.
constexpr int lone_size = 33;
/// Line buffers: three of a stencil, one of scratch.
constexpr int lines_a_worker = 4;

/// A row from a column on.
ConstRow3 from(ConstRow3 row, int col) { return {row.x + col, row.y + col, row.z + col}; }
Row3 from(Row3 row, int col) { return {row.x + col, row.y + col, row.z + col}; }

}  // namespace

/// The workers of a level: all of the team, or one for whom the others wait.
struct MultigridPreconditioner::Workers {
  Worker& worker;
  bool alone;

  [[nodiscard]] Range share(int count) const {
    return alone ? Range{0, count} : worker.share(count);
  }
  void barrier() const {
    if (!alone) worker.barrier();
  }
  void average(const BorderMates& mates, Planes3& planes) const {
    if (mates.class_count() == 0) return;
    if (alone)
      average_over_mates(mates, {&planes.x, &planes.y, &planes.z});
    else
      average_over_mates(mates, worker, {&planes.x, &planes.y, &planes.z});
    barrier();
  }
  void sum(const BorderMates& mates, Planes3& planes) const {
    if (mates.class_count() == 0) return;
    if (alone)
      sum_over_mates(mates, {&planes.x, &planes.y, &planes.z});
    else
      sum_over_mates(mates, worker, {&planes.x, &planes.y, &planes.z});
    barrier();
  }
};

MultigridPreconditioner::MultigridPreconditioner(const Cloth& cloth, const Options& options,
                                                 const ThreadTeam& team)
    : factors_(sweep_factors(options.sweeps)),
      levels_(make_filter_levels(cloth, options.time_step)),
      moves_(cloth.size, cloth.size),
      factor_(levels_.back()),
      block_factor_(levels_.back()),
      kernels_(&kernels_for(team.instructions())),
      lines_(3 * lines_a_worker * team.size(), cloth.size),
      sums_(cloth.size) {
  renew_pins(cloth);
}

void MultigridPreconditioner::renew_pins(const Cloth& cloth) {
  pinned_.clear();
  for (const Pin& held : cloth.pins) pinned_.push_back(held.sample);
  for (int r = 0; r < cloth.size; ++r)
    for (int c = 0; c < cloth.size; ++c) moves_(r, c) = cloth.inverse_mass(r, c) > 0 ? 1.0F : 0.0F;
  renew_weights(levels_, moves_);
  if (factor_.fits()) factor_.renew(levels_.back());
}

bool MultigridPreconditioner::knows_pins(const Cloth& cloth) const {
  return std::equal(cloth.pins.begin(), cloth.pins.end(), pinned_.begin(), pinned_.end(),
                    [](const Pin& held, int sample) { return held.sample == sample; });
}

Row3 MultigridPreconditioner::lines(const Worker& worker, int index) {
  const int first = 3 * (lines_a_worker * worker.rank() + index);
  return {lines_.row(first), lines_.row(first + 1), lines_.row(first + 2)};
}

void MultigridPreconditioner::renew_contacts(const ContactLoads& contacts, Worker& worker) {
  const bool touching = contacts.stiff() > 0;
  const bool idle = !touching && !touching_;
  worker.barrier();
  if (idle) return;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    FilterLevel& level = levels_[i];
    const Range mine = worker.share(level.size());
    for (int r = mine.first; r < mine.last; ++r) {
      if (i == 0)
        level.contacts.set_row(contacts, r);
      else
        level.contacts.restrict_row(levels_[i - 1].contacts, r, lines(worker, 3).x);
      level.contacts.invert_row(r, level.inverse_diagonal.row(r));
    }
    worker.barrier();
    level.contacts.join_mates(level.mates, level.inverse_diagonal,
                              worker.share(level.mates.class_count()));
  }
  if (worker.rank() == 0) {
    touching_ = touching;
    if (touching && block_factor_.fits()) block_factor_.renew(levels_.back());
  }
  worker.barrier();
}

void MultigridPreconditioner::first_sweep_row(const FilterLevel& level, int row, Row3 out) const {
  const ConstRow3 rhs = row_of(level.rhs, row);
  const float factor = factors_.front();
  if (!level.contacts.row(row))
    return kernels_->first_sweep(level.size(), factor, level.inverse_diagonal.row(row), rhs, out);
  level.contacts.for_runs(row, [&](Range columns, bool touched) {
    const int c = columns.first, n = columns.last - c;
    if (touched) {
      kernels_->apply_blocks(n, factor, level.contacts.inverse_row(row, c), from(rhs, c),
                             from(out, c));
    } else {
      kernels_->first_sweep(n, factor, level.inverse_diagonal.row(row) + c, from(rhs, c),
                            from(out, c));
    }
  });
}

void MultigridPreconditioner::apply_row(const FilterLevel& level, int row, const StencilRows& x,
                                        Row3 out) const {
  kernels_->apply(level.size(), level.operator_row(row), x, out);
  if (!level.contacts.row(row)) return;
  level.contacts.for_runs(row, [&](Range columns, bool touched) {
    const int c = columns.first;
    if (touched)
      kernels_->subtract_blocks(columns.last - c, level.contacts.own_row(row, c), from(x.here, c),
                                from(out, c));
  });
}

/// Computes the residual after one sweep from zero, which is never stored: three lines hold it.
void MultigridPreconditioner::lone_sweep_residual(FilterLevel& level, const Workers& workers) {
  const int n = level.size();
  const Range mine = workers.share(n);
  const auto smooth = [&](int r) { first_sweep_row(level, r, lines(workers.worker, r % 3)); };
  const auto read = [&](int r) {
    const Row3 row = lines(workers.worker, r % 3);
    return ConstRow3{row.x, row.y, row.z};
  };
  for (int r = std::max(0, mine.first - 1); r < std::min(n, mine.first + 1); ++r) smooth(r);
  for (int r = mine.first; r < mine.last; ++r) {
    if (r + 1 < n) smooth(r + 1);
    const Row3 out = row_of(level.result, r);
    apply_row(level, r, {read(std::max(0, r - 1)), read(r), read(std::min(n - 1, r + 1))}, out);
    kernels_->add_rhs(n, level.share_row(r), level.inverse_diagonal.row(r),
                      row_of(std::as_const(level.rhs), r), out);
  }
  workers.barrier();
}

/// Computes the residual after two sweeps and leaves the iterate in `value`, where up() expects it.
void MultigridPreconditioner::two_sweeps_residual(FilterLevel& level, const Workers& workers) {
  const int n = level.size();
  const Range mine = workers.share(n);
  for (int r = mine.first; r < mine.last; ++r) first_sweep_row(level, r, row_of(level.value, r));
  workers.barrier();
  level_sweep(level, factors_.back(), workers);
  exchange(level, workers);
  for (int r = mine.first; r < mine.last; ++r) {
    const Row3 out = row_of(level.result, r);
    apply_row(level, r, level.stencil_rows(r), out);
    kernels_->add_rhs(n, level.share_row(r), level.inverse_diagonal.row(r),
                      row_of(std::as_const(level.rhs), r), out);
  }
  workers.barrier();
}

void MultigridPreconditioner::down(FilterLevel& fine, FilterLevel& coarse, const Workers& workers) {
  if (factors_.size() == 1)
    lone_sweep_residual(fine, workers);
  else
    two_sweeps_residual(fine, workers);
  if (!coarse.matched) workers.average(fine.mates, fine.result);
  const int n = fine.size();
  const float* zero = fine.zeros.row(0);
  const ConstRow3 none{zero, zero, zero};
  const Planes3& residual = fine.result;
  const Range mine = workers.share(coarse.size());
  for (int r = mine.first; r < mine.last; ++r) {
    const StencilRows rows{r > 0 ? row_of(residual, 2 * r - 1) : none, row_of(residual, 2 * r),
                           2 * r + 1 < n ? row_of(residual, 2 * r + 1) : none};
    kernels_->restrict_rows(n, rows, lines(workers.worker, 3), row_of(coarse.rhs, r));
  }
  workers.barrier();
  workers.sum(coarse.mates, coarse.rhs);
}

void MultigridPreconditioner::up(const FilterLevel& coarse, FilterLevel& fine,
                                 const Workers& workers) {
  const int n = fine.size();
  const Range mine = workers.share(n);
  for (int r = mine.first; r < mine.last; ++r) {
    const float* inverse = fine.inverse_diagonal.row(r);
    if (factors_.size() == 1) first_sweep_row(fine, r, row_of(fine.value, r));
    kernels_->interpolate(n, row_of(coarse.result, r / 2), row_of(coarse.result, (r + 1) / 2),
                          inverse, lines(workers.worker, 3), row_of(fine.value, r));
  }
  workers.barrier();
  if (!coarse.matched) workers.average(fine.mates, fine.value);
}

/// @return rhs . result of the row
double MultigridPreconditioner::sweep_row(FilterLevel& level, int row, float factor) {
  const Row3 out = row_of(level.result, row);
  apply_row(level, row, level.stencil_rows(row), out);
  const SweepRow sweep{
      factor,
      level.inverse_diagonal.row(row),
      level.share_row(row),
      level.count_row(row),
      row_of(std::as_const(level.rhs), row),
      row_of(std::as_const(level.value), row),
  };
  if (level.contacts.row(row)) return contact_sweep_row(level, row, sweep, out);
  return kernels_->sweep(level.size(), sweep, out);
}

/// Sweeps a row with contacts: with blocks in place of the diagonal where contacts touch.
double MultigridPreconditioner::contact_sweep_row(const FilterLevel& level, int row,
                                                  const SweepRow& sweep, Row3 out) const {
  level.contacts.for_runs(row, [&](Range columns, bool touched) {
    const int c = columns.first, n = columns.last - c;
    const float* count = sweep.count == nullptr ? nullptr : sweep.count + c;
    const float* share = sweep.share == nullptr ? nullptr : sweep.share + c;
    const ConstRow3 rhs = from(sweep.rhs, c), value = from(sweep.value, c);
    if (touched) {
      const BlockRow inverse = level.contacts.inverse_row(row, c);
      kernels_->block_sweep(n, {sweep.factor, inverse, count, rhs, value}, from(out, c));
    } else {
      kernels_->sweep(n, {sweep.factor, sweep.inverse + c, share, count, rhs, value}, from(out, c));
    }
  });
  return kernels_->dot(level.size(), sweep.share, sweep.rhs, {out.x, out.y, out.z});
}

/// A sweep over a level. Every sample is updated as if its own part, times the number of mates,
/// were that of its class; the mean over the mates is then the update of the class.
void MultigridPreconditioner::level_sweep(FilterLevel& level, float factor,
                                          const Workers& workers) {
  const Range mine = workers.share(level.size());
  for (int r = mine.first; r < mine.last; ++r) sweep_row(level, r, factor);
  workers.barrier();
  workers.average(level.mates, level.result);
}

double MultigridPreconditioner::finest_sweep(Worker& worker) {
  FilterLevel& level = levels_.front();
  const Workers workers{worker, false};
  const double slope =
      sums_.sum(worker, [&](int r) { return sweep_row(level, r, factors_.front()); });
  workers.average(level.mates, level.result);
  return slope;
}

void MultigridPreconditioner::exchange(FilterLevel& level, const Workers& workers) {
  if (workers.alone || workers.worker.rank() == 0) std::swap(level.value, level.result);
  workers.barrier();
}

void MultigridPreconditioner::solve_coarsest(FilterLevel& level, const Workers& workers) {
  if (touching_ && block_factor_.fits()) {
    if (workers.alone || workers.worker.rank() == 0) block_factor_.solve(level);
    return workers.barrier();
  }
  if (!touching_ && factor_.fits()) {
    // One worker solves for all coordinates at once, as a solve is bound by latency.
    const Range mine = workers.share(1);
    if (mine.last > mine.first) factor_.solve(level, *kernels_);
    return workers.barrier();
  }
  const Range mine = workers.share(level.size());
  for (int r = mine.first; r < mine.last; ++r) first_sweep_row(level, r, row_of(level.result, r));
  for (int i = 1; i < coarsest_sweeps; ++i) {
    workers.barrier();
    exchange(level, workers);
    level_sweep(level, factors_.front(), workers);
  }
}

/// Cycles over level `index` and all below it. The other workers wait for a lone worker at the end.
void MultigridPreconditioner::below(std::size_t index, Worker& worker) {
  FilterLevel& level = levels_[index];
  const bool lone = index > 0 && level.size() <= lone_size;
  if (lone && worker.rank() != 0) return;
  const Workers workers{worker, lone};
  if (index + 1 == levels_.size()) return solve_coarsest(level, workers);
  const bool next_lone = !lone && levels_[index + 1].size() <= lone_size;
  down(level, levels_[index + 1], workers);
  below(index + 1, worker);
  if (next_lone) worker.barrier();
  up(levels_[index + 1], level, workers);
  for (std::size_t i = factors_.size(); i-- > 1;) {
    level_sweep(level, factors_[i], workers);
    exchange(level, workers);
  }
  if (index > 0) level_sweep(level, factors_.front(), workers);
}

double MultigridPreconditioner::cycle(Worker& worker) {
  below(0, worker);
  if (levels_.size() > 1) return finest_sweep(worker);
  const FilterLevel& level = levels_.front();
  return sums_.sum(worker, [&](int r) {
    return kernels_->dot(level.size(), level.share_row(r), row_of(level.rhs, r),
                         row_of(level.result, r));
  });
}

}  // namespace weft
