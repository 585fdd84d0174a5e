#include "weft/collide/moving_surface.h"

#include <numeric>

namespace weft {
namespace {

/// Links the samples of each class of mates to a ring.
std::vector<int> rings_of_copies(int samples, const BorderMates& mates) {
  std::vector<int> next(static_cast<std::size_t>(samples));
  std::iota(next.begin(), next.end(), 0);
  for (int i = 0; i < mates.class_count(); ++i) {
    const std::span<const int> copies = mates.copies(i);
    for (std::size_t k = 0; k < copies.size(); ++k)
      next[copies[k]] = copies[(k + 1) % copies.size()];
  }
  return next;
}

}  // namespace

SurfaceGrid::SurfaceGrid(int size, const BorderMates& mates, const Grid<Diagonal>& diagonals,
                         const BorderMates* sewn)
    : size_(size),
      point_(static_cast<std::size_t>(size) * size),
      next_copy_(rings_of_copies(size * size, mates)),
      chart_(mates.chart_of()),
      diagonal_(static_cast<std::size_t>(size - 1) * (size - 1), Diagonal::rising),
      seams_(mates) {
  for (int s = 0; s < size * size; ++s) point_[s] = mates.size() > 0 ? mates.representative(s) : s;
  for (int s = 0; sewn != nullptr && s < size * size; ++s)
    joint_.push_back(sewn->representative(s));
  for (int r = 0; r < diagonals.rows(); ++r)
    for (int c = 0; c < diagonals.cols(); ++c) {
      diagonal_[r * (size - 1) + c] = diagonals(r, c);
      has_missing_ = has_missing_ || diagonals(r, c) == Diagonal::none;
    }
  features_ = assign_features(*this);
}

}  // namespace weft
