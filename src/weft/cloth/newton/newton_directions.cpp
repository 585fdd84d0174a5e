#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "weft/cloth/newton/newton_part.h"

// A cloth's part in the iterations of conjugate gradients.
namespace weft {

Vec3d NewtonPart::force(Worker& worker) {
  const PaddedPlane* const left[3] = {&residual_.x, &residual_.y, &residual_.z};
  double sum[3];
  for (int k = 0; k < 3; ++k)
    sum[k] = sums_.sum(worker, [&](int r) {
      const float *f = left[k]->row(r), *share = share_.row(r);
      return lane_sum(cloth_.size, [&](int c) { return double{share[c]} * double{f[c]}; });
    });
  return {sum[0], sum[1], sum[2]};
}

void NewtonPart::drift(Vec3d displacement, Worker& worker) {
  const auto h = static_cast<float>(input_.time_step);
  const Vec3f moved = vec_cast<float>(displacement);
  const float parts[3] = {moved.x, moved.y, moved.z}, per_square = 1 / (h * h);
  PaddedPlane* const step[3] = {&step_.x, &step_.y, &step_.z};
  PaddedPlane* const left[3] = {&residual_.x, &residual_.y, &residual_.z};
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r)
    for (int k = 0; k < 3; ++k)
      for (int c = 0; c < cloth_.size; ++c) {
        (*step[k])(r, c) += parts[k];
        (*left[k])(r, c) -= share_(r, c) > 0 ? per_square * cloth_.mass(r, c) * parts[k] : 0;
      }
  worker.barrier();
}

double NewtonPart::start_direction(bool along_last, Worker& worker) {
  if (!along_last) {
    const Range mine = worker.share(cloth_.size);
    for (int r = mine.first; r < mine.last; ++r) clear_row(direction_.row(r), cloth_.size);
    worker.barrier();
    return 0;
  }
  multigrid_.clear_pins(direction_, worker);
  return sums_.sum(worker, [&](int r) {
    return kernels_.dot(whole_vectors(cloth_.size), shares_of(r), std::as_const(residual_).row(r),
                        std::as_const(direction_).row(r));
  });
}

double NewtonPart::end_cycle(const Contacts& contacts, bool has_product, Worker& worker) {
  multigrid_.smooth_last(exact(contacts), worker);
  if (!has_product) return 0;
  return sums_.sum(worker, [&](int r) {
    return kernels_.dot(whole_vectors(cloth_.size), shares_of(r), std::as_const(product_).row(r),
                        std::as_const(multigrid_).value().row(r));
  });
}

double NewtonPart::update_direction(double overlap, Worker& worker) {
  const int n = whole_vectors(cloth_.size);
  return sums_.sum(worker, [&](int r) {
    return kernels_.update(n, shares_of(r), std::as_const(multigrid_).value().row(r),
                           static_cast<float>(-overlap), std::as_const(residual_).row(r),
                           direction_.row(r));
  });
}

double NewtonPart::multiply(const Contacts& contacts, Worker& worker) {
  multigrid_.apply(direction_,
                   {exact(contacts), curved_.active() ? &curved_ : nullptr, row_parts_.data()},
                   product_, worker);
  return std::accumulate(row_parts_.begin(), row_parts_.end(), 0.0);
}

double NewtonPart::advance(double length, Worker& worker) {
  const int n = whole_vectors(cloth_.size);
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) {
    largest_[r] = kernels_.advance(n, static_cast<float>(length), std::as_const(direction_).row(r),
                                   std::as_const(product_).row(r), step_.row(r), residual_.row(r));
  }
  worker.barrier();
  if (worker.rank() == 0) last_length_ = length;
  return std::abs(length) * std::sqrt(double{*std::max_element(largest_.begin(), largest_.end())});
}

}  // namespace weft
