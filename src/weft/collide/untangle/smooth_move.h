#pragma once

#include <vector>

#include "weft/collide/moving_surface.h"
#include "weft/grid.h"

namespace weft {

/// Continues moves that are wanted at some samples over the rest of an image, so that what is
/// around goes along: pulled up the mip pyramid as weighted means and pushed down again into what
/// knows nothing [gortler96]. From some 2^levels samples away nothing moves.
class SmoothMove {
 public:
  /// Begins anew, with nothing wanted.
  void clear(const SurfaceGrid& grid, int levels);
  /// Wants a move of a sample (which stands for its class), by so much weight.
  void want(int sample, Vec3d move, double weight);
  /// To be called once all is wanted.
  void spread(const SurfaceGrid& grid);
  /// Of a sample that stands for its class. [m]
  [[nodiscard]] Vec3d at(int sample) const { return moves_.front()[sample].move; }

 private:
  struct Wanted {
    Vec3d move;  // times weight, then the mean
    double weight = 0;
  };
  void pull(std::size_t level);
  void push(std::size_t level);
  void gather_classes(const SurfaceGrid& grid);

  std::vector<int> sides_;                  // samples a side of each level
  std::vector<std::vector<Wanted>> moves_;  // of each level
};

}  // namespace weft
