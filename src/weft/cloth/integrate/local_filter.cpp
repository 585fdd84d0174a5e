#include "weft/cloth/integrate/local_filter.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "weft/cloth/integrate/filter_matrix.h"

namespace weft {
namespace {

/// Columns that are taken together; with the reach of the patch they stay in the first cache.
constexpr int block = 64;
/// Outputs of one side that are taken together, a multiple of this.
constexpr int side_lanes = 4;
/// Columns of one vector; a multiple of every instruction set's.
constexpr int width = 16;

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
      centred_(static_cast<std::size_t>(patch_) * patch_ * (half_ + 1)),
      beside_(static_cast<std::size_t>(patch_) * patch_ * patch_ * lanes_) {
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

const float* LocalFilter::centred(int patch_row, int row) const {
  return &centred_[(static_cast<std::size_t>(patch_row) * patch_ + row) * (half_ + 1)];
}

const float* LocalFilter::beside(int patch_row, int row) const {
  return &beside_[(static_cast<std::size_t>(patch_row) * patch_ + row) * patch_ * lanes_];
}

int LocalFilter::terms_of(const Grid<float>& in, int row, Term* terms) const {
  const int top = std::clamp(row - half_, 0, size_ - patch_);
  const int place = row - top;
  const bool mirrors = place == half_;
  const int count = mirrors ? half_ + 1 : patch_;
  for (int k = 0; k < count; ++k) {
    const bool paired = mirrors && k < half_;
    terms[k] = {in.row(top + k), paired ? in.row(top + patch_ - 1 - k) : nullptr, centred(place, k),
                beside(place, k)};
  }
  return count;
}

void LocalFilter::apply_centred(const Term* terms, int count, float* out) const {
  constexpr int reach = largest_patch / 2;
  std::array<float, block + 2 * reach + width> line;
  for (int first = half_; first < size_ - half_; first += block) {
    const int columns = std::min(block, size_ - half_ - first), from = first - half_;
    std::array<float, block> sums{};
    for (int k = 0; k < count; ++k) {
      const float *a = terms[k].row, *b = terms[k].mirrored;
      const int wide = columns + 2 * half_;
      std::copy(a + from, a + from + wide, line.begin());
      if (b != nullptr) {
#pragma omp simd
        for (int c = 0; c < wide; ++c) line[c] += b[from + c];
      }
      std::fill(line.begin() + wide, line.begin() + wide + width, 0.0F);
      for (int c = 0; c < columns; c += width) {
        const float *middle = &line[c + half_], *w = terms[k].centred;
        std::array<float, width> sum;
#pragma omp simd
        for (int i = 0; i < width; ++i) sum[i] = sums[c + i] + w[0] * middle[i];
        for (int l = 1; l <= half_; ++l) {
#pragma omp simd
          for (int i = 0; i < width; ++i) sum[i] += w[l] * (middle[i - l] + middle[i + l]);
        }
#pragma omp simd
        for (int i = 0; i < width; ++i) sums[c + i] = sum[i];
      }
    }
    std::copy(sums.begin(), sums.begin() + columns, out + first);
  }
}

void LocalFilter::apply_beside(const Term* terms, int count, float* out) const {
  for (int first = 0; first < half_; first += side_lanes) {
    std::array<float, side_lanes> left{}, right{};
    for (int k = 0; k < count; ++k) {
      const float *a = terms[k].row, *b = terms[k].mirrored;
      const float* w = terms[k].beside + first;
      for (int l = 0; l < patch_; ++l, w += lanes_) {
        const int r = size_ - 1 - l;
        const float at_left = b == nullptr ? a[l] : a[l] + b[l];
        const float at_right = b == nullptr ? a[r] : a[r] + b[r];
#pragma omp simd
        for (int i = 0; i < side_lanes; ++i) {
          left[i] += w[i] * at_left;
          right[i] += w[i] * at_right;
        }
      }
    }
    for (int i = 0; i < std::min(side_lanes, half_ - first); ++i) {
      out[first + i] = left[i];
      out[size_ - 1 - first - i] = right[i];
    }
  }
}

void LocalFilter::apply_plane_row(const Grid<float>& in, Grid<float>& out, int row) const {
  std::array<Term, largest_patch> terms;
  const int count = terms_of(in, row, terms.data());
  apply_beside(terms.data(), count, out.row(row));
  apply_centred(terms.data(), count, out.row(row));
}

void LocalFilter::apply_row(const Planes3& in, Planes3& out, int row) const {
  apply_plane_row(in.x, out.x, row);
  apply_plane_row(in.y, out.y, row);
  apply_plane_row(in.z, out.z, row);
}

}  // namespace weft
