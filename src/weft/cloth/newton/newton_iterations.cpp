#include <algorithm>
#include <cmath>
#include <utility>

#include "weft/cloth/newton/newton_solver.h"

// Conjugate gradients for one linearisation of a step.
namespace weft {

double NewtonSolver::dot(const PaddedVectors& a, const PaddedVectors& b, Worker& worker) {
  const bool seamed = !multigrid_.seams().empty();
  return sums_.sum(worker, [&](int r) {
    return kernels_.dot(cloth_.size, seamed ? share_.row(r) : nullptr, a.row(r), b.row(r));
  });
}

/// Inner forces sum to nothing: what nothing holds moves as a whole as if it were one particle.
bool NewtonSolver::flies() const { return cloth_.pins.empty() && contacts_.active() == 0; }

/// The step of the whole, from the residual: so that free fall is exact.
Vec3d NewtonSolver::drift(Worker& worker) {
  Vec3d sum;
  const PaddedPlane* const residual[3] = {&residual_.x, &residual_.y, &residual_.z};
  double* const part[3] = {&sum.x, &sum.y, &sum.z};
  for (int k = 0; k < 3; ++k)
    *part[k] = sums_.sum(worker, [&](int r) {
      const float *f = residual[k]->row(r), *share = share_.row(r);
      return lane_sum(cloth_.size, [&](int c) { return double{share[c]} * double{f[c]}; });
    });
  return (input_.time_step * input_.time_step / mass_) * sum;
}

/// Adds a step of the whole, and takes what it balances off the residual.
void NewtonSolver::add_drift(Vec3d way, Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  const auto h = static_cast<float>(input_.time_step);
  const Vec3f moved = vec_cast<float>(way);
  const float parts[3] = {moved.x, moved.y, moved.z}, per_square = 1 / (h * h);
  PaddedPlane* const step[3] = {&step_.x, &step_.y, &step_.z};
  PaddedPlane* const left[3] = {&residual_.x, &residual_.y, &residual_.z};
  for (int r = mine.first; r < mine.last; ++r)
    for (int k = 0; k < 3; ++k)
      for (int c = 0; c < cloth_.size; ++c) {
        (*step[k])(r, c) += parts[k];
        (*left[k])(r, c) -= per_square * cloth_.mass(r, c) * parts[k];
      }
  worker.barrier();
}

void NewtonSolver::iterate(Progress& progress, Worker& worker) {
  const int n = cloth_.size;
  const Range mine = worker.share(n);
  for (int r = mine.first; r < mine.last; ++r)
    copy_row(std::as_const(residual_).row(r), multigrid_.rhs().row(r), n);
  worker.barrier();
  multigrid_.cycle(worker);
  const double slope = dot(residual_, multigrid_.value(), worker);
  const auto beta = static_cast<float>(progress.slope > 0 ? slope / progress.slope : 0);
  progress.slope = slope;
  for (int r = mine.first; r < mine.last; ++r) {
    kernels_.scale_add(n, multigrid_.value().row(r), beta, direction_.row(r));
    largest_[r] = kernels_.largest(n, std::as_const(direction_).row(r));
  }
  worker.barrier();
  const bool touching = contacts_.active() > 0;
  if (touching) contacts_.load_product(direction_, worker);
  multigrid_.apply(direction_,
                   {touching ? &contacts_.loads() : nullptr, curved_.active() ? &curved_ : nullptr},
                   product_, worker);
  const double curvature = dot(direction_, product_, worker);
  const double length = curvature > 0 && slope > 0 ? slope / curvature : 0;
  for (int r = mine.first; r < mine.last; ++r) {
    kernels_.add_scaled(n, static_cast<float>(length), std::as_const(direction_).row(r),
                        step_.row(r));
    kernels_.add_scaled(n, static_cast<float>(-length), std::as_const(product_).row(r),
                        residual_.row(r));
  }
  worker.barrier();
  progress.correction =
      length * std::sqrt(double{*std::max_element(largest_.begin(), largest_.end())});
  if (worker.rank() == 0) last_length_ = length;
  progress.promised += 0.5 * length * slope;
  // What this iteration took off the energy, as a force on every particle over its weight.
  progress.force = std::sqrt(length * slope / mass_) / (input_.time_step * 9.81);
  ++progress.iterations;
}

void NewtonSolver::solve(const NewtonOptions& options, Progress& progress, Worker& worker) {
  progress.slope = 0;
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) clear_row(direction_.row(r), cloth_.size);
  worker.barrier();
  for (int i = 0; i < options.max_iterations; ++i) {
    iterate(progress, worker);
    if (progress.force < options.tolerance) break;
  }
}

}  // namespace weft
