#include "weft/collide/broad_phase/patch_motion.h"

#include <algorithm>
#include <cmath>

#include "weft/collide/broad_phase/min_max.h"

namespace weft {
namespace {

/// Raises squared displacements of a row of samples to those between two grids.
void raise(const Planes3& from, const Planes3& to, int row, float* squared) {
  const int n = from.size();
  const float *x = from.x.row(row), *y = from.y.row(row), *z = from.z.row(row);
  const float *u = to.x.row(row), *v = to.y.row(row), *w = to.z.row(row);
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    const float dx = u[c] - x[c], dy = v[c] - y[c], dz = w[c] - z[c];
    squared[c] = max(squared[c], dx * dx + dy * dy + dz * dz);
  }
}

/// Part of the blocks from which it is faster to renew all.
constexpr double worth_all = 0.9;

void copy_samples(const Planes3& from, int row, Range cols, Planes3& to) {
  const auto copy = [&](const Grid<float>& source, Grid<float>& target) {
    std::copy(source.row(row) + cols.first, source.row(row) + cols.last,
              target.row(row) + cols.first);
  };
  copy(from.x, to.x);
  copy(from.y, to.y);
  copy(from.z, to.z);
}

}  // namespace

PatchMotion::PatchMotion(int cells)
    : size_(cells + 1),
      patches_((cells + side - 1) / side),
      start_(size_),
      end_(size_),
      squared_(blocks(), size_),
      blocks_(static_cast<std::size_t>(blocks()) * blocks(), HUGE_VALF),
      distances_(static_cast<std::size_t>(patches_) * patches_, HUGE_VALF),
      versions_(cells) {}

void PatchMotion::measure_blocks(const MovingSurface& now, int row) {
  float* squared = squared_.row(row);
  std::fill_n(squared, size_, 0.0F);
  for (int r = side * row; r < std::min(size_, side * (row + 1)); ++r) {
    raise(start_, *now.start, r, squared);
    raise(end_, *now.end, r, squared);
  }
  for (int b = 0; b < blocks(); ++b) {
    const float largest =
        *std::max_element(squared + side * b, squared + std::min(size_, side * (b + 1)));
    // What is not finite is far.
    blocks_[static_cast<std::size_t>(row) * blocks() + b] =
        largest < HUGE_VALF ? std::sqrt(largest) : HUGE_VALF;
  }
}

/// A patch has samples of up to four blocks.
void PatchMotion::join_distances(int row) {
  const int n = blocks();
  const float* upper = blocks_.data() + static_cast<std::size_t>(row) * n;
  const float* lower = blocks_.data() + static_cast<std::size_t>(std::min(row + 1, n - 1)) * n;
  for (int c = 0; c < patches_; ++c) {
    const int next = std::min(c + 1, n - 1);
    distances_[static_cast<std::size_t>(row) * patches_ + c] =
        max(max(upper[c], upper[next]), max(lower[c], lower[next]));
  }
}

void PatchMotion::measure(const MovingSurface& now, Worker& worker) {
  if (!known_) return worker.barrier();
  const Range rows = worker.share(blocks());
  for (int r = rows.first; r < rows.last; ++r) measure_blocks(now, r);
  worker.barrier();
  const Range mine = worker.share(patches_);
  for (int r = mine.first; r < mine.last; ++r) join_distances(r);
  worker.barrier();
}

void PatchMotion::renew_block(const MovingSurface& now, int row, int col) {
  const Range cols{side * col, std::min(size_, side * (col + 1))};
  for (int r = side * row; r < std::min(size_, side * (row + 1)); ++r) {
    copy_samples(*now.start, r, cols, start_);
    copy_samples(*now.end, r, cols, end_);
  }
  blocks_[static_cast<std::size_t>(row) * blocks() + col] = 0;
}

void PatchMotion::renew_all(const MovingSurface& now, int version) {
  start_ = *now.start;
  end_ = *now.end;
  std::fill(blocks_.begin(), blocks_.end(), 0.0F);
  std::fill(distances_.begin(), distances_.end(), 0.0F);
  versions_.set_all(version);
  known_ = true;
}

void PatchMotion::renew(const MovingSurface& now, float limit, int version) {
  const auto far =
      std::count_if(blocks_.begin(), blocks_.end(), [&](float moved) { return !(moved <= limit); });
  if (!known_ || static_cast<double>(far) > worth_all * static_cast<double>(blocks_.size()))
    return renew_all(now, version);
  const int n = blocks();
  bool any = false;
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      if (blocks_[static_cast<std::size_t>(r) * n + c] <= limit) continue;
      any = true;
      renew_block(now, r, c);
      for (int i = std::max(0, r - 1); i <= std::min(r, patches_ - 1); ++i)
        for (int j = std::max(0, c - 1); j <= std::min(c, patches_ - 1); ++j)
          versions_.set(i, j, version);
    }
  for (int r = 0; any && r < patches_; ++r) join_distances(r);
}

void PatchMotion::forget() {
  known_ = false;
  std::fill(blocks_.begin(), blocks_.end(), HUGE_VALF);
}

}  // namespace weft
