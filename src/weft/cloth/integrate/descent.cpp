#include "weft/cloth/integrate/descent.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "weft/cloth/forces.h"
#include "weft/cloth/integrate/proposal.h"
#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

/// Of the secant: directions are as long as the filter, which is too stiff, makes them.
constexpr double most_way = 4;

/// The dot product of a row of own parts with a row of whole values: summed over all samples it
/// counts every particle once.
double dot_row(const Planes3& own, const Planes3& whole, int row) {
  const ConstRow3 a = row_of(own, row), b = row_of(whole, row);
  return lane_sum(own.size(), [&](int c) {
    return double{a.x[c]} * double{b.x[c]} + double{a.y[c]} * double{b.y[c]} +
           double{a.z[c]} * double{b.z[c]};
  });
}

}  // namespace

Descent::Descent(const Cloth& cloth, double time_step)
    : cloth_(cloth),
      time_step_(time_step),
      filter_(cloth, time_step),
      contacts_(cloth.size),
      start_(rest_state(cloth)),
      next_(rest_state(cloth)),
      fall_(cloth.size),
      move_(cloth.size),
      direction_(cloth.size),
      residual_(cloth.size),
      far_residual_(cloth.size),
      sums_(cloth.size),
      largest_(static_cast<std::size_t>(cloth.size)) {}

void Descent::renew_filter() {
  if (input_.time_step != time_step_) {
    time_step_ = input_.time_step;
    filter_ = MultigridFilter(cloth_, time_step_);
  } else if (!filter_.knows_pins(cloth_)) {
    filter_.renew_pins(cloth_);
  }
}

void Descent::begin(const StepInput& input, const ClothState& state, ThreadTeam& team) {
  input_ = input;
  iterations_ = 0;
  correction_ = 0;
  contacts_.clear();
  renew_filter();
  team.run([&](Worker& worker) {
    copy_rows(state, start_, worker);
    const Range mine = worker.share(cloth_.size);
    for (int r = mine.first; r < mine.last; ++r) {
      fall_row(r);
      place_row(0, r);
    }
  });
  hold_pins();
}

void Descent::run(std::span<const Contact> contacts, const MultigridOptions& options,
                  ThreadTeam& team) {
  contacts_.choose(cloth_, contacts, next_.position);
  team.run([&](Worker& worker) {
    contacts_.push_out(cloth_, fall_, move_, worker);
    descend(options, worker);
  });
  hold_pins();
}

void Descent::hold_pins() {
  for (const Pin& held : cloth_.pins)
    for (const int sample : held.copies) fall_.set(sample, vec_cast<float>(held.target));
  set_pins(cloth_, start_, input_.time_step, next_);
}

void Descent::fall_row(int row) {
  const auto h = static_cast<float>(input_.time_step);
  const Vec3f g = input_.gravity;
  const ConstRow3 x = row_of(std::as_const(start_.position), row);
  const ConstRow3 v = row_of(std::as_const(start_.velocity), row);
  const Row3 y = row_of(fall_, row), z = row_of(move_, row);
  for (int c = 0; c < cloth_.size; ++c) {
    y.x[c] = x.x[c] + h * (v.x[c] + h * g.x);
    y.y[c] = x.y[c] + h * (v.y[c] + h * g.y);
    y.z[c] = x.z[c] + h * (v.z[c] + h * g.z);
    z.x[c] = z.y[c] = z.z[c] = 0;
  }
}

void Descent::place_row(float way, int row) {
  const auto h = static_cast<float>(input_.time_step);
  const Vec3f g = input_.gravity;
  const ConstRow3 y = row_of(std::as_const(fall_), row), z = row_of(std::as_const(move_), row);
  const ConstRow3 d = row_of(std::as_const(direction_), row);
  const ConstRow3 v = row_of(std::as_const(start_.velocity), row);
  const Row3 x1 = row_of(next_.position, row), v1 = row_of(next_.velocity, row);
  const float per_step = 1 / h;
#pragma omp simd
  for (int c = 0; c < cloth_.size; ++c) {
    const float dx = z.x[c] + way * d.x[c];
    const float dy = z.y[c] + way * d.y[c];
    const float dz = z.z[c] + way * d.z[c];
    x1.x[c] = y.x[c] + dx;
    x1.y[c] = y.y[c] + dy;
    x1.z[c] = y.z[c] + dz;
    v1.x[c] = v.x[c] + h * g.x + per_step * dx;
    v1.y[c] = v.y[c] + h * g.y + per_step * dy;
    v1.z[c] = v.z[c] + h * g.z + per_step * dz;
  }
}

void Descent::residual_row(float way, Planes3& out, int row) {
  gather_damped(cloth_, row, next_, out);
  const float* weight = filter_.mass_weight().row(row);
  const ConstRow3 z = row_of(std::as_const(move_), row);
  const ConstRow3 d = row_of(std::as_const(direction_), row);
  const Row3 r = row_of(out, row);
#pragma omp simd
  for (int c = 0; c < cloth_.size; ++c) {
    r.x[c] -= weight[c] * (z.x[c] + way * d.x[c]);
    r.y[c] -= weight[c] * (z.y[c] + way * d.y[c]);
    r.z[c] -= weight[c] * (z.z[c] + way * d.z[c]);
  }
  contacts_.filter_row(out, row);
}

void Descent::look(float way, Planes3& out, Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) place_row(way, r);
  worker.barrier();
  for (int r = mine.first; r < mine.last; ++r) residual_row(way, out, r);
  worker.barrier();
}

void Descent::copy_right_row(int row) {
  const ConstRow3 r = row_of(std::as_const(residual_), row);
  const Row3 b = row_of(filter_.right(), row);
  std::copy(r.x, r.x + cloth_.size, b.x);
  std::copy(r.y, r.y + cloth_.size, b.y);
  std::copy(r.z, r.z + cloth_.size, b.z);
}

void Descent::step_difference_row(int row) {
  const ConstRow3 now = row_of(std::as_const(residual_), row);
  const ConstRow3 before = row_of(std::as_const(filter_.right()), row);
  const Row3 out = row_of(far_residual_, row);
  for (int c = 0; c < cloth_.size; ++c) {
    out.x[c] = now.x[c] - before.x[c];
    out.y[c] = now.y[c] - before.y[c];
    out.z[c] = now.z[c] - before.z[c];
  }
}

void Descent::turn_row(float beta, int row) {
  const ConstRow3 w = row_of(filter_.value(), row);
  const Row3 d = row_of(direction_, row);
  for (int c = 0; c < cloth_.size; ++c) {
    d.x[c] = w.x[c] + beta * d.x[c];
    d.y[c] = w.y[c] + beta * d.y[c];
    d.z[c] = w.z[c] + beta * d.z[c];
  }
  contacts_.filter_row(direction_, row);
}

double Descent::turn(double last_slope, Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  // The residual before the step is the filter's right side still.
  for (int r = mine.first; r < mine.last; ++r) {
    if (last_slope > 0) step_difference_row(r);
    copy_right_row(r);
  }
  worker.barrier();
  filter_.cycle(worker);
  const Planes3& w = filter_.value();
  const double slope = sums_.sum(worker, [&](int r) { return dot_row(residual_, w, r); });
  double beta = 0;
  if (last_slope > 0) {
    const double change = sums_.sum(worker, [&](int r) { return dot_row(far_residual_, w, r); });
    beta = std::max(0.0, change / last_slope);
  }
  for (int r = mine.first; r < mine.last; ++r) turn_row(static_cast<float>(beta), r);
  worker.barrier();
  return slope;
}

void Descent::step_row(float way, int row) {
  const ConstRow3 d = row_of(std::as_const(direction_), row);
  const ConstRow3 far = row_of(std::as_const(far_residual_), row);
  const Row3 z = row_of(move_, row), r = row_of(residual_, row);
  float largest = 0;
  for (int c = 0; c < cloth_.size; ++c) {
    z.x[c] += way * d.x[c];
    z.y[c] += way * d.y[c];
    z.z[c] += way * d.z[c];
    r.x[c] += way * (far.x[c] - r.x[c]);
    r.y[c] += way * (far.y[c] - r.y[c]);
    r.z[c] += way * (far.z[c] - r.z[c]);
    largest = std::max(largest, d.x[c] * d.x[c] + d.y[c] * d.y[c] + d.z[c] * d.z[c]);
  }
  largest_[static_cast<std::size_t>(row)] = way * std::sqrt(largest);
}

double Descent::go(Worker& worker) {
  look(1, far_residual_, worker);
  const double here = sums_.sum(worker, [&](int r) { return dot_row(residual_, direction_, r); });
  const double there =
      sums_.sum(worker, [&](int r) { return dot_row(far_residual_, direction_, r); });
  const double bend = here - there;
  const double way = bend > 0 && here > 0 ? std::min(here / bend, most_way) : 1.0;
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) step_row(static_cast<float>(way), r);
  worker.barrier();
  float largest = 0;
  for (const float row : largest_) largest = std::max(largest, row);
  worker.barrier();
  return double{largest} / cloth_.rest_spacing;
}

void Descent::descend(const MultigridOptions& options, Worker& worker) {
  double slope = 0, correction = 0;
  int done = 0;
  look(0, residual_, worker);
  while (done < options.max_iterations) {
    slope = turn(slope, worker);
    correction = go(worker);
    ++done;
    if (!(correction > options.tolerance)) break;
  }
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) place_row(0, r);
  if (worker.rank() != 0) return;
  iterations_ += done;
  correction_ = correction;
}

}  // namespace weft
