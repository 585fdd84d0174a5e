#include "weft/collide/moving_surface.h"

namespace weft {

SurfaceGrid::SurfaceGrid(int size, const BorderMates& mates, const Grid<Diagonal>& diagonals,
                         const BorderMates* sewn)
    : size_(size),
      point_(static_cast<std::size_t>(size) * size),
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
