#include "weft/cloth/integrate/local_filter.h"

#include <algorithm>
#include <array>

#include "weft/cloth/integrate/filter_matrix.h"

namespace weft {
namespace {

FilterGrid uniform_patch(int size, double ratio) {
  FilterGrid patch;
  patch.size = size;
  patch.particle_of.resize(static_cast<std::size_t>(size) * size);
  for (std::size_t i = 0; i < patch.particle_of.size(); ++i)
    patch.particle_of[i] = static_cast<int>(i);
  patch.mass.assign(patch.particle_of.size(), 1.0);
  for (Grid<double>& plane : patch.stiffness) plane = Grid<double>(size, size, ratio);
  patch.time_step = 1;
  return patch;
}

}  // namespace

LocalFilter::LocalFilter(int image_size, int patch_size, double ratio)
    : size_(image_size),
      patch_(patch_size),
      matrix_(filter_matrix(uniform_patch(patch_size, ratio))) {}

const float* LocalFilter::weights(int patch_row, int patch_col) const {
  const std::size_t count = static_cast<std::size_t>(patch_) * patch_;
  return matrix_.data() + count * (static_cast<std::size_t>(patch_row) * patch_ + patch_col);
}

void LocalFilter::apply_plane_row(const Grid<float>& in, Grid<float>& out, int row) const {
  // Columns whose patch is centred share their weights: they are taken together, a few at a time.
  constexpr int together = 16;
  const int half = patch_ / 2;
  const int top = std::clamp(row - half, 0, size_ - patch_);
  float* to = out.row(row);
  const auto one = [&](int c) {
    const int left = std::clamp(c - half, 0, size_ - patch_);
    const float* w = weights(row - top, c - left);
    float sum = 0;
    for (int k = 0; k < patch_; ++k)
      for (int l = 0; l < patch_; ++l) sum += *w++ * in.row(top + k)[left + l];
    to[c] = sum;
  };
  const float* centred = weights(row - top, half);
  int c = 0;
  for (; c < half; ++c) one(c);
  for (; c + together <= size_ - half; c += together) {
    std::array<float, together> sums{};
    const float* w = centred;
    for (int k = 0; k < patch_; ++k)
      for (int l = 0; l < patch_; ++l, ++w) {
        const float* from = in.row(top + k) + (c - half + l);
#pragma omp simd
        for (int i = 0; i < together; ++i) sums[i] += *w * from[i];
      }
    std::copy(sums.begin(), sums.end(), to + c);
  }
  for (; c < size_; ++c) one(c);
}

void LocalFilter::apply_row(const Planes3& in, Planes3& out, int row) const {
  apply_plane_row(in.x, out.x, row);
  apply_plane_row(in.y, out.y, row);
  apply_plane_row(in.z, out.z, row);
}

}  // namespace weft
