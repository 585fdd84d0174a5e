#include "weft/cloth/baselines/nonlinear_pcg.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "weft/cloth/integrator.h"
#include "weft/cloth/mates.h"
#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

/// Bound of the secant's step length: the filter is too stiff, so its directions are too short.
constexpr double max_step_length = 4;
/// Factor of the iterations under contact. Contact forces move a cloth out of its surface, where
/// springs give way; the filter, which is as stiff in every direction, needs more iterations there.
constexpr int iterations_under_contact = 4;
/// Factor of the tolerance under contact: contacts are so stiff that forces are still wrong where
/// positions are good enough.
constexpr double tolerance_under_contact = 1e-4;
/// Iterations until the residual is computed anew: interpolated along secants it drifts away from
/// the gradient.
constexpr int iterations_between_restarts = 4;

/// Squared relative rounding of positions in single precision, generously. A smaller displacement
/// does not count as a move by the caller.
constexpr float rounding = 1e-12F;
/// Number of filters that are kept: of a step and of its halves.
constexpr std::size_t max_filters = 7;

void copy_row(ConstRow3 from, Row3 to, int n) {
  std::copy(from.x, from.x + n, to.x);
  std::copy(from.y, from.y + n, to.y);
  std::copy(from.z, from.z + n, to.z);
}

}  // namespace

NonlinearPcg::NonlinearPcg(const Cloth& cloth, double time_step, ThreadTeam& team)
    : cloth_(cloth),
      team_(team),
      kernels_(kernels_for(team.instructions())),
      contacts_(cloth),
      springs_(cloth, team),
      bending_(cloth, team.instructions()),
      start_(rest_state(cloth)),
      next_(rest_state(cloth)),
      fall_(cloth.size),
      move_(cloth.size),
      direction_(cloth.size),
      far_residual_(cloth.size),
      sums_(cloth.size),
      largest_(static_cast<std::size_t>(cloth.size)) {
  filters_.push_back({time_step, std::make_unique<MultigridPreconditioner>(
                                     cloth, MultigridPreconditioner::Options{time_step}, team)});
  filter_ = filters_.front().filter.get();
}

void NonlinearPcg::renew_filter() {
  const auto made = std::find_if(filters_.begin(), filters_.end(), [&](const TimedFilter& of) {
    return of.time_step == input_.time_step;
  });
  if (made != filters_.end()) {
    std::rotate(filters_.begin(), made, made + 1);
  } else {
    if (filters_.size() == max_filters) filters_.pop_back();
    filters_.insert(
        filters_.begin(),
        {input_.time_step, std::make_unique<MultigridPreconditioner>(
                               cloth_, MultigridPreconditioner::Options{input_.time_step}, team_)});
  }
  filter_ = filters_.front().filter.get();
  if (!filter_->knows_pins(cloth_)) filter_->renew_pins(cloth_);
}

void NonlinearPcg::begin(const StepInput& input, const ClothState& state) {
  input_ = input;
  iterations_ = 0;
  correction_ = 0;
  pending_step_length_ = 0;
  contacts_.clear();
  renew_filter();
  team_.run([&](Worker& worker) {
    copy_rows(state, start_, worker);
    const Range mine = worker.share(cloth_.size);
    for (int r = mine.first; r < mine.last; ++r) {
      fall_row(r);
      place_row(0, r);
    }
  });
  hold_pins();
}

void NonlinearPcg::run(std::span<const Contact> contacts, const MultigridOptions& options) {
  contacts_.set_contacts(contacts, start_.position, input_.time_step);
  team_.run([&](Worker& worker) {
    contacts_.update_active(next_.position, filter_->finest().inverse_diagonal, worker);
    const Range mine = worker.share(cloth_.size);
    const auto pending = static_cast<float>(pending_step_length_);
    for (int r = mine.first; r < mine.last; ++r) {
      accept_row(pending, r);
      update_moved_row(r);
      place_row(0, r);
    }
    worker.barrier();
    update_contacts(worker);
    const SolverState solver_state = descend(options, worker);
    if (worker.rank() != 0) return;
    pending_step_length_ = solver_state.step_length;
    iterations_ += solver_state.iterations;
    correction_ = solver_state.correction;
  });
  hold_pins();
}

void NonlinearPcg::last_corrections(Grid<float>& sizes) const {
  const auto scale = static_cast<float>(pending_step_length_ / cloth_.rest_spacing);
  for (int r = 0; r < cloth_.size; ++r)
    for (int c = 0; c < cloth_.size; ++c) sizes(r, c) = scale * length(direction_.at(r, c));
}

void NonlinearPcg::hold_pins() {
  for (const Pin& held : cloth_.pins)
    for (const int sample : held.copies) fall_.set(sample, vec_cast<float>(held.target));
  set_pins(cloth_, start_, input_.time_step, next_);
}

void NonlinearPcg::fall_row(int row) {
  const auto h = static_cast<float>(input_.time_step);
  const Vec3f g = input_.gravity;
  const ConstRow3 x = row_of(std::as_const(start_.position), row);
  const ConstRow3 v = row_of(std::as_const(start_.velocity), row);
  const Row3 y = row_of(fall_, row), z = row_of(move_, row), d = row_of(direction_, row);
  for (int c = 0; c < cloth_.size; ++c) {
    y.x[c] = x.x[c] + h * (v.x[c] + h * g.x);
    y.y[c] = x.y[c] + h * (v.y[c] + h * g.y);
    y.z[c] = x.z[c] + h * (v.z[c] + h * g.z);
    z.x[c] = z.y[c] = z.z[c] = 0;
    d.x[c] = d.y[c] = d.z[c] = 0;
  }
}

void NonlinearPcg::place_row(float step_length, int row) {
  const auto h = static_cast<float>(input_.time_step);
  const Vec3f g = input_.gravity;
  kernels_.place(cloth_.size, {step_length,
                               1 / h,
                               {h * g.x, h * g.y, h * g.z},
                               row_of(std::as_const(fall_), row),
                               row_of(std::as_const(move_), row),
                               row_of(std::as_const(direction_), row),
                               row_of(std::as_const(start_.velocity), row),
                               row_of(next_.position, row),
                               row_of(next_.velocity, row)});
}

void NonlinearPcg::accept_row(float step_length, int row) {
  if (step_length == 0) return;
  const Row3 z = row_of(move_, row), d = row_of(direction_, row);
  for (int c = 0; c < cloth_.size; ++c) {
    z.x[c] += step_length * d.x[c];
    z.y[c] += step_length * d.y[c];
    z.z[c] += step_length * d.z[c];
    d.x[c] = d.y[c] = d.z[c] = 0;
  }
}

void NonlinearPcg::update_moved_row(int row) {
  const float* inverse_mass = cloth_.inverse_mass.row(row);
  for (int c = 0; c < cloth_.size; ++c) {
    const Vec3f x = next_.position.at(row, c), y = fall_.at(row, c);
    const Vec3f moved = x - y - move_.at(row, c);
    const float hair = rounding * (squared_length(x) + squared_length(y));
    if (inverse_mass[c] > 0 && squared_length(moved) > hair) move_.set(row, c, x - y);
  }
}

double NonlinearPcg::evaluate_gradient(Worker& worker) {
  const SpringRows::Motion motion{next_.position, start_.position, input_.time_step};
  bending_.curve(next_.position, worker);
  springs_.begin(motion, worker);
  if (!contacts_.empty()) contacts_.update_forces({fall_, move_, direction_, 1}, worker);
  const double along = sums_.sum(worker, [&](int r) {
    const Row3 out = row_of(far_residual_, r);
    copy_row(springs_.row(motion, r, worker), out, cloth_.size);
    bending_.add_row(1, r, far_residual_);
    if (contacts_.loads().row(r)) contacts_.loads().add_row(r, out);
    return kernels_.inertia(cloth_.size, filter_->mass_weight().row(r),
                            row_of(std::as_const(move_), r), row_of(std::as_const(direction_), r),
                            out);
  });
  if (cloth_.mates.class_count() > 0) {
    sum_over_mates(cloth_.mates, worker, {&far_residual_.x, &far_residual_.y, &far_residual_.z});
    worker.barrier();
  }
  return along;
}

void NonlinearPcg::update_residual(SolverState& solver_state, Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) {
    const ConstRow3 far = row_of(std::as_const(far_residual_), r);
    if (solver_state.exact)
      copy_row(far, row_of(filter_->rhs(), r), cloth_.size);
    else
      kernels_.step_residual(cloth_.size, static_cast<float>(solver_state.step_length), far,
                             row_of(filter_->rhs(), r));
  }
  solver_state.exact = false;
  worker.barrier();
}

double NonlinearPcg::update_direction(SolverState& solver_state, Worker& worker) {
  const double slope = filter_->cycle(worker);
  double beta = solver_state.slope > 0 ? slope / solver_state.slope : 0;
  // Restarts if the residual grows or the direction leads up in energy.
  if (!(beta <= 1) || !(slope + beta * solver_state.left > 0)) beta = 0;
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) {
    largest_[static_cast<std::size_t>(r)] = kernels_.update_direction(
        cloth_.size, {static_cast<float>(solver_state.step_length), static_cast<float>(beta),
                      row_of(std::as_const(fall_), r), row_of(std::as_const(filter_->value()), r),
                      row_of(move_, r), row_of(direction_, r), row_of(next_.position, r)});
  }
  worker.barrier();
  solver_state.slope = slope;
  return slope + beta * solver_state.left;
}

double NonlinearPcg::largest_direction() const {
  return std::sqrt(double{*std::max_element(largest_.begin(), largest_.end())});
}

void NonlinearPcg::advance(double slope, SolverState& solver_state, Worker& worker) {
  const double there = evaluate_gradient(worker);
  const double bend = slope - there;
  solver_state.step_length = bend > 0 && slope > 0 ? std::min(slope / bend, max_step_length) : 1.0;
  solver_state.left = slope - solver_state.step_length * bend;
  solver_state.correction = solver_state.step_length * largest_direction() / cloth_.rest_spacing;
  ++solver_state.iterations;
}

bool NonlinearPcg::restart(SolverState& solver_state, Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) {
    accept_row(static_cast<float>(solver_state.step_length), r);
    place_row(0, r);
  }
  worker.barrier();
  const bool changed = update_contacts(worker);
  evaluate_gradient(worker);
  solver_state.slope = solver_state.left = solver_state.step_length = 0;
  solver_state.exact = true;
  return changed;
}

bool NonlinearPcg::update_contacts(Worker& worker) {
  bool changed =
      contacts_.update_active(next_.position, filter_->finest().inverse_diagonal, worker);
  if (!contacts_.empty())
    changed = contacts_.update_friction({fall_, move_, direction_, 0}, worker) || changed;
  filter_->renew_contacts(contacts_.loads(), worker);
  return changed;
}

NonlinearPcg::SolverState NonlinearPcg::descend(const MultigridOptions& options, Worker& worker) {
  evaluate_gradient(worker);
  SolverState solver_state;
  const bool pressed = !contacts_.empty();
  const int max = options.max_iterations * (pressed ? iterations_under_contact : 1);
  const double tolerance = options.tolerance * (pressed ? tolerance_under_contact : 1);
  bool converged = false;
  while (solver_state.iterations < max) {
    const bool stale =
        solver_state.iterations > 0 && solver_state.iterations % iterations_between_restarts == 0;
    // Under contact it has converged only if an update leaves the contacts as they are.
    if ((stale || converged) && !restart(solver_state, worker) && converged) break;
    update_residual(solver_state, worker);
    advance(update_direction(solver_state, worker), solver_state, worker);
    converged = !(solver_state.correction > tolerance);
    if (converged && !pressed) break;
  }
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r)
    place_row(static_cast<float>(solver_state.step_length), r);
  worker.barrier();
  if (!contacts_.empty()) {
    contacts_.update_forces(
        {fall_, move_, direction_, static_cast<float>(solver_state.step_length)}, worker);
    contacts_.spare(worker);
  }
  return solver_state;
}

}  // namespace weft
