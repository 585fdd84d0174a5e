#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "weft/cloth/newton/newton_solver.h"
#include "weft/core/math.h"

// Conjugate gradients for one linearisation of a step.
namespace weft {

double NewtonSolver::dot(const PaddedVectors& a, const PaddedVectors& b, Worker& worker) {
  const bool seamed = !multigrid_.seams().empty();
  return sums_.sum(worker, [&](int r) {
    return kernels_.dot(whole_vectors(cloth_.size), seamed ? share_.row(r) : nullptr, a.row(r),
                        b.row(r));
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

/// The direction becomes the preconditioned residual, less what the last direction has of it. The
/// slope is taken along what is left, which may be rounding alone.
void NewtonSolver::turn(Progress& progress, Worker& worker) {
  const int n = whole_vectors(cloth_.size);
  const PaddedVectors& value = multigrid_.value();
  const auto share = [&](int r) { return multigrid_.seams().empty() ? nullptr : share_.row(r); };
  double overlap = 0;
  if (progress.curvature > 0)
    overlap = sums_.sum(worker, [&](int r) {
      return kernels_.dot(n, share(r), std::as_const(product_).row(r), value.row(r));
    }) / progress.curvature;
  progress.slope = sums_.sum(worker, [&](int r) {
    kernels_.scale_add(n, value.row(r), static_cast<float>(-overlap), direction_.row(r));
    return kernels_.dot(n, share(r), std::as_const(residual_).row(r),
                        std::as_const(direction_).row(r));
  });
}

/// Goes along the direction to where the energy of the linearisation is least.
void NewtonSolver::descend_direction(Progress& progress, Worker& worker) {
  const int n = whole_vectors(cloth_.size);
  const Range mine = worker.share(cloth_.size);
  const bool touching = contacts_.active() > 0;
  if (touching) contacts_.load_product(direction_, worker);
  multigrid_.apply(direction_,
                   {touching ? &contacts_.loads() : nullptr, curved_.active() ? &curved_ : nullptr,
                    row_parts_.data()},
                   product_, worker);
  progress.curvature = total_of_rows();
  const double length = progress.curvature > 0 ? progress.slope / progress.curvature : 0;
  for (int r = mine.first; r < mine.last; ++r) {
    const ConstRow3 direction = std::as_const(direction_).row(r);
    largest_[r] = kernels_.largest(n, direction);
    kernels_.add_scaled(n, static_cast<float>(length), direction, step_.row(r));
    kernels_.add_scaled(n, static_cast<float>(-length), std::as_const(product_).row(r),
                        residual_.row(r));
  }
  worker.barrier();
  progress.correction =
      std::abs(length) * std::sqrt(double{*std::max_element(largest_.begin(), largest_.end())});
  if (worker.rank() == 0) last_length_ = length;
  progress.promised += 0.5 * length * progress.slope;
  // What this took off the energy, as a force on every particle over its weight.
  progress.force =
      std::sqrt(length * progress.slope / mass_) / (input_.time_step * standard_gravity);
}

void NewtonSolver::iterate(Progress& progress, Worker& worker) {
  multigrid_.cycle(worker);
  turn(progress, worker);
  // A cycle is no symmetric operator: where it points up, the way down is backwards.
  if (!std::isfinite(progress.slope)) progress.slope = 0;
  descend_direction(progress, worker);
  ++progress.iterations;
}

/// Starts along what the last step changed, which cloth that moves on is likely to change again.
void NewtonSolver::start_direction(Progress& progress, Worker& worker) {
  progress.curvature = 0;
  if (!progress.first) {
    const Range mine = worker.share(cloth_.size);
    for (int r = mine.first; r < mine.last; ++r) clear_row(direction_.row(r), cloth_.size);
    return worker.barrier();
  }
  progress.first = false;
  multigrid_.clear_pins(direction_, worker);
  progress.slope = dot(residual_, direction_, worker);
  descend_direction(progress, worker);
}

void NewtonSolver::solve(const NewtonOptions& options, Progress& progress, Worker& worker) {
  start_direction(progress, worker);
  for (int i = 0; i < options.max_iterations; ++i) {
    iterate(progress, worker);
    if (progress.force < options.tolerance) break;
  }
}

double NewtonSolver::total_of_rows() const {
  return std::accumulate(row_parts_.begin(), row_parts_.end(), 0.0);
}

}  // namespace weft
