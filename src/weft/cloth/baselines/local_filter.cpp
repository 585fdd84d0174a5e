#include "weft/cloth/baselines/local_filter.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "weft/cloth/baselines/filter_matrix.h"

namespace weft {
namespace {

/// Columns of one side are taken so many at a time.
constexpr int side_lanes = 4;

FilterGrid uniform_patch(int size, double ratio) {
  FilterGrid patch;
  patch.size = size;
  patch.particle_of.resize(static_cast<std::size_t>(size) * size);
  std::iota(patch.particle_of.begin(), patch.particle_of.end(), 0);
  patch.mass.assign(patch.particle_of.size(), 1.0);
  for (Grid<double>& plane : patch.stiffness) plane = Grid<double>(size, size, ratio);
  patch.time_step = 1;
  return patch;
}

}  // namespace

LocalFilter::LocalFilter(int image_size, int patch_size, double ratio, ThreadTeam& team)
    : size_(image_size),
      patch_(patch_size),
      half_(patch_size / 2),
      lanes_((half_ + side_lanes - 1) / side_lanes * side_lanes),
      kernels_(filtering_kernels_for(team.instructions())),
      centred_(static_cast<std::size_t>(patch_) * patch_ * (half_ + 1)),
      beside_(static_cast<std::size_t>(patch_) * patch_ * patch_ * lanes_),
      lines_(2 * (half_ + 1) * team.size(), image_size) {
  const Grid<float> w = filter_matrix(uniform_patch(patch_, ratio), team);
  float *centred = centred_.data(), *beside = beside_.data();
  for (int place = 0; place < patch_; ++place)
    for (int row = 0; row < patch_; ++row) {
      // Solved apart, mirror images differ by rounding.
      const auto weight = [&](int col, int to) {
        const int i = place * patch_ + col;
        const float one = w(i, row * patch_ + to);
        return place == half_ ? 0.5F * (one + w(i, (patch_ - 1 - row) * patch_ + to)) : one;
      };
      for (int distance = 0; distance <= half_; ++distance)
        *centred++ = 0.5F * (weight(half_, half_ - distance) + weight(half_, half_ + distance));
      for (int to = 0; to < patch_; ++to)
        for (int col = 0; col < lanes_; ++col) *beside++ = col < half_ ? weight(col, to) : 0.0F;
    }
}

PatchWeights LocalFilter::weights(int patch_row) const {
  const std::size_t rows = static_cast<std::size_t>(patch_row) * patch_;
  return {half_, patch_row == half_ ? half_ + 1 : patch_, lanes_, &centred_[rows * (half_ + 1)],
          &beside_[rows * patch_ * lanes_]};
}

void LocalFilter::apply_plane_row(const Grid<float>& in, Grid<float>& out, int row,
                                  const Worker& worker) {
  const int top = std::clamp(row - half_, 0, size_ - patch_);
  const PatchWeights patch = weights(row - top);
  const int scratch = 2 * (half_ + 1) * worker.rank();
  std::array<const float*, largest_patch> rows{};
  for (int k = 0; k < patch.rows; ++k) {
    rows[k] = in.row(top + k);
    // Rows at one distance above and below have one weight.
    if (row - top != half_ || k == half_) continue;
    float* both = lines_.row(scratch + k);
    kernels_.add_rows(size_, rows[k], in.row(top + patch_ - 1 - k), both);
    rows[k] = both;
  }
  kernels_.patch_row(size_, rows.data(), patch, lines_.row(scratch + half_ + 1), out.row(row));
}

void LocalFilter::apply_row(const Planes3& in, Planes3& out, int row, const Worker& worker) {
  apply_plane_row(in.x, out.x, row, worker);
  apply_plane_row(in.y, out.y, row, worker);
  apply_plane_row(in.z, out.z, row, worker);
}

}  // namespace weft
