#include "bench/tight_solver.h"

#include <algorithm>
#include <cmath>

namespace weft::bench {
namespace {

void write(const Field& field, PaddedVectors& out) {
  const int n = out.rows();
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const Vec3f v = vec_cast<float>(field[r * n + c]);
      out.x(r, c) = v.x;
      out.y(r, c) = v.y;
      out.z(r, c) = v.z;
    }
}

}  // namespace

TightSolver::TightSolver(const Cloth& cloth, const TightOptions& options)
    : cloth_(cloth),
      options_(options),
      energy_(cloth),
      kernels_(newton_kernels_for(team_.instructions())),
      springs_(cloth, kernels_),
      multigrid_(cloth, 1, kernels_),
      state_(cloth.size),
      still_(cloth.size),
      unused_(cloth.size, cloth.size) {
  for (Field* field :
       {&gradient_, &step_, &residual_, &before_, &direction_, &product_, &value_, &trial_})
    field->resize(std::size_t(cloth.size) * cloth.size);
}

/// The cycle is for float: residuals are brought near 1 first.
void TightSolver::precondition(const Field& residual, Field& out) {
  const double size = std::max(largest(residual), 1e-300);
  Field scaled = residual;
  for (Vec3d& v : scaled) v = (1 / size) * v;
  write(scaled, multigrid_.rhs());
  team_.run([&](Worker& worker) { multigrid_.cycle(worker); });
  const PaddedVectors& value = multigrid_.value();
  const int n = cloth_.size;
  for (int s = 0; s < n * n; ++s) {
    const int r = s / n, c = s % n;
    out[s] = energy_.moves(s) ? size * Vec3d{value.x(r, c), value.y(r, c), value.z(r, c)} : Vec3d{};
  }
}

/// The start of the step is where it is now: then all tension counts across springs.
void TightSolver::set_up_preconditioner(const Field& position) {
  write(position, state_.position);
  write(position, state_.start);
  team_.run([&](Worker& worker) {
    multigrid_.linearise({state_, still_, {}, 1}, nullptr, springs_, unused_, worker);
    for (int r = 0; r < cloth_.size; ++r) multigrid_.fill_diagonals(springs_, r);
    multigrid_.set_up(springs_, worker);
  });
}

/// step_ = -A^-1 gradient_. The cycle rounds to float, so directions are made conjugate to the last
/// one with the residual's change. @return false where A is not positive
bool TightSolver::solve() {
  std::fill(step_.begin(), step_.end(), Vec3d{});
  std::fill(direction_.begin(), direction_.end(), Vec3d{});
  for (std::size_t s = 0; s < step_.size(); ++s) residual_[s] = -1.0 * gradient_[s];
  before_ = residual_;
  double slope = 0, first = 0;
  for (int i = 0; i < options_.max_inner; ++i) {
    precondition(residual_, value_);
    const double next = dot(residual_, value_), changed = next - dot(before_, value_);
    if (i == 0) first = next;
    if (!std::isfinite(next)) throw std::runtime_error("the cycle gives no number");
    if (!(next > options_.inner_tolerance * options_.inner_tolerance * first)) return true;
    const double beta = i > 0 ? std::max(0.0, changed / slope) : 0;
    for (std::size_t s = 0; s < step_.size(); ++s) direction_[s] = value_[s] + beta * direction_[s];
    slope = next;
    energy_.product(direction_, product_);
    const double curvature = dot(direction_, product_);
    if (!(curvature > 0)) return false;
    const double length = dot(residual_, direction_) / curvature;
    before_ = residual_;
    add(length, direction_, step_);
    add(-length, product_, residual_);
  }
  return true;
}

/// Without the exact Hessian the last moves shrink by a tenth each where springs are compressed.
void TightSolver::find_step(const Field& position, double last_move) {
  energy_.gradient(position, gradient_);
  set_up_preconditioner(position);
  if (last_move < options_.exact_below) {
    energy_.linearise(position, TightEnergy::Hessian::exact);
    if (solve()) return;
  }
  energy_.linearise(position, TightEnergy::Hessian::positive_part);
  (void)solve();
}

/// Halves step_ until it lowers the energy. @return the largest move of the whole step [m]
double TightSolver::move(Field& position) {
  const double before = energy_.step_energy(position), slope = dot(gradient_, step_);
  double length = 1;
  for (int i = 0; i < 20; ++i, length *= 0.5) {
    trial_ = position;
    add(length, step_, trial_);
    const double rounding = 1e-13 * std::abs(before);
    if (energy_.step_energy(trial_) <= before + 1e-4 * length * slope + rounding) break;
  }
  std::swap(position, trial_);
  return largest(step_);
}

bool TightSolver::step(const StepInput& input, TightState& state) {
  energy_.begin(input, state);
  springs_.set_time_step(input.time_step);
  Field position = state.position;
  add(input.time_step, state.velocity, position);
  double moved = HUGE_VAL;
  for (int i = 0; i < options_.max_newton && moved >= options_.tolerance; ++i) {
    find_step(position, moved);
    moved = move(position);
  }
  for (std::size_t s = 0; s < position.size(); ++s)
    state.velocity[s] = (1 / input.time_step) * (position[s] - state.position[s]);
  state.position = std::move(position);
  return moved < options_.tolerance;
}

}  // namespace weft::bench
