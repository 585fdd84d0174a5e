#include "weft/cloth/multigrid/filter.h"

#include <algorithm>
#include <array>
#include <utility>

#include "weft/cloth/mates.h"
#include "weft/cloth/mip_levels.h"
#include "weft/cloth/multigrid/filter_rows.h"
#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

// Jacobi steps that damp the eigenvalues of D^-1 A between these: the upper is Gershgorin's bound
// without what shear takes off it, the lower what the next level no longer sees.
constexpr float upper = 1.9F, lower = 0.4F;
constexpr int sweeps = 2;
// Where a coarsest level is too large to be factored: all of its spectrum, as far as that goes.
constexpr float coarsest_lower = 0.01F;
constexpr int coarsest_sweeps = 24;

/// One over the two Chebyshev roots of [low, high].
std::array<float, sweeps> factors(float low, float high) {
  static_assert(sweeps == 2);
  constexpr float root = 0.70710678F;
  const float middle = 0.5F * (high + low), half = 0.5F * (high - low);
  return {1 / (middle + half * root), 1 / (middle - half * root)};
}

Line3 line_of(FilterLevel& level, int row) {
  float* line = level.line.row(row);
  const int n = level.size();
  return {line, line + n, line + 2 * n};
}

}  // namespace

MultigridFilter::MultigridFilter(const Cloth& cloth, double time_step)
    : levels_(make_filter_levels(cloth, time_step)),
      moves_(cloth.size, cloth.size),
      factor_(levels_.back()) {
  renew_pins(cloth);
}

void MultigridFilter::renew_pins(const Cloth& cloth) {
  for (int r = 0; r < cloth.size; ++r)
    for (int c = 0; c < cloth.size; ++c) moves_(r, c) = cloth.inverse_mass(r, c) > 0 ? 1.0F : 0.0F;
  renew_weights(levels_, moves_);
  if (factor_.fits()) factor_.renew(levels_.back());
}

bool MultigridFilter::knows_pins(const Cloth& cloth) const {
  for (int r = 0; r < cloth.size; ++r)
    for (int c = 0; c < cloth.size; ++c)
      if ((cloth.inverse_mass(r, c) > 0) != (moves_(r, c) > 0)) return false;
  return true;
}

void MultigridFilter::finish_sweep(FilterLevel& level, float factor, Worker& worker) {
  worker.barrier();
  if (level.mates.class_count() > 0) {
    Planes3 &next = level.next, &own = level.residual;
    const int n = level.size();
    const Range mine = worker.share(level.mates.class_count());
    for (int index = mine.first; index < mine.last; ++index) {
      const std::span<const int> samples = level.mates.mates(index);
      Vec3f sum;
      for (const int s : samples) sum = sum + own.at(s);
      const int first = samples.front();
      const float step = factor * level.inverse_diagonal(first / n, first % n);
      const Vec3f value = level.value.at(first) + step * sum;
      for (const int s : samples) next.set(s, value);
    }
    worker.barrier();
  }
  if (worker.rank() == 0) std::swap(level.value, level.next);
  worker.barrier();
}

void MultigridFilter::first_sweep(FilterLevel& level, float factor, Worker& worker) {
  const int n = level.size();
  const Range mine = worker.share(n);
  for (int r = mine.first; r < mine.last; ++r) {
    const ConstRow3 b = row_of(std::as_const(level.right), r);
    const Row3 x = row_of(level.next, r), own = row_of(level.residual, r);
    const Row3 zero = row_of(level.value, r);
    const float* inverse = level.inverse_diagonal.row(r);
#pragma omp simd
    for (int c = 0; c < n; ++c) {
      const float step = factor * inverse[c];
      x.x[c] = step * b.x[c];
      x.y[c] = step * b.y[c];
      x.z[c] = step * b.z[c];
      own.x[c] = b.x[c];
      own.y[c] = b.y[c];
      own.z[c] = b.z[c];
      zero.x[c] = zero.y[c] = zero.z[c] = 0;
    }
  }
  finish_sweep(level, factor, worker);
}

void MultigridFilter::sweep(FilterLevel& level, float factor, Worker& worker) {
  const int n = level.size();
  const Range mine = worker.share(n);
  for (int r = mine.first; r < mine.last; ++r) {
    const Line3 line = line_of(level, r);
    residual_row(level, level.value, level.right, r, line);
    const ConstRow3 x = row_of(std::as_const(level.value), r);
    const Row3 out = row_of(level.next, r), own = row_of(level.residual, r);
    const float* inverse = level.inverse_diagonal.row(r);
#pragma omp simd
    for (int c = 0; c < n; ++c) {
      const float step = factor * inverse[c];
      out.x[c] = x.x[c] + step * line.x[c];
      out.y[c] = x.y[c] + step * line.y[c];
      out.z[c] = x.z[c] + step * line.z[c];
      own.x[c] = line.x[c];
      own.y[c] = line.y[c];
      own.z[c] = line.z[c];
    }
  }
  finish_sweep(level, factor, worker);
}

void MultigridFilter::restrict_residual(FilterLevel& fine, FilterLevel& coarse, Worker& worker) {
  Range mine = worker.share(fine.size());
  for (int r = mine.first; r < mine.last; ++r) {
    const Row3 out = row_of(fine.residual, r);
    residual_row(fine, fine.value, fine.right, r, {out.x, out.y, out.z});
    const float* inverse = fine.inverse_diagonal.row(r);
    for (int c = 0; c < fine.size(); ++c)
      if (inverse[c] == 0) out.x[c] = out.y[c] = out.z[c] = 0;
  }
  worker.barrier();
  if (!coarse.matched) {
    average_over_mates(fine.mates, worker, {&fine.residual.x, &fine.residual.y, &fine.residual.z});
    worker.barrier();
  }
  mine = worker.share(coarse.size());
  for (int r = mine.first; r < mine.last; ++r) {
    float* line = coarse.line.row(r);
    const Row3 out = row_of(coarse.right, r);
    restrict_plane_row(fine.residual.x, nullptr, r, line, out.x);
    restrict_plane_row(fine.residual.y, nullptr, r, line, out.y);
    restrict_plane_row(fine.residual.z, nullptr, r, line, out.z);
  }
  worker.barrier();
}

void MultigridFilter::prolong(const FilterLevel& coarse, FilterLevel& fine, Worker& worker) {
  const Range mine = worker.share(fine.size());
  const bool finest = &fine == &levels_.front();
  for (int r = mine.first; r < mine.last; ++r) {
    const Row3 out = row_of(fine.value, r);
    const float* moves = finest ? moves_.row(r) : nullptr;
    add_interpolated_row(coarse.value.x, r, moves, out.x);
    add_interpolated_row(coarse.value.y, r, moves, out.y);
    add_interpolated_row(coarse.value.z, r, moves, out.z);
  }
  worker.barrier();
  if (coarse.matched) return;
  average_over_mates(fine.mates, worker, {&fine.value.x, &fine.value.y, &fine.value.z});
  worker.barrier();
}

void MultigridFilter::solve_coarsest(FilterLevel& level, Worker& worker) {
  if (factor_.fits()) return factor_.solve(level, worker);
  const auto steps = factors(coarsest_lower, upper);
  first_sweep(level, steps[0], worker);
  for (int i = 1; i < coarsest_sweeps; ++i) sweep(level, steps[i % 2], worker);
}

void MultigridFilter::descend(std::size_t index, Worker& worker) {
  FilterLevel& level = levels_[index];
  if (index + 1 == levels_.size()) return solve_coarsest(level, worker);
  const auto steps = factors(lower, upper);
  first_sweep(level, steps[0], worker);
  for (int i = 1; i < sweeps; ++i) sweep(level, steps[i], worker);
  restrict_residual(level, levels_[index + 1], worker);
  descend(index + 1, worker);
  prolong(levels_[index + 1], level, worker);
  for (int i = sweeps - 1; i >= 0; --i) sweep(level, steps[i], worker);
}

void MultigridFilter::cycle(Worker& worker) { descend(0, worker); }

}  // namespace weft
