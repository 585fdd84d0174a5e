#pragma once

#include <vector>

#include "weft/collide/moving_surface.h"
#include "weft/grid.h"

namespace weft {

/// Extends displacements of some samples smoothly over the rest of an image by pull-push on its mip
/// pyramid [gortler96]: weighted means upwards, interpolation downwards into samples without a
/// displacement. Samples more than some 2^levels away do not move.
class SmoothMove {
 public:
  /// Starts anew without displacements.
  void clear(const SurfaceGrid& grid, int levels);
  /// Adds a displacement [m] of a representative sample, with a weight.
  void want(int sample, Vec3d move, double weight);
  /// Computes the displacements of all samples; to be called once all wanted ones are added.
  void spread(const SurfaceGrid& grid);
  /// Displacement of a representative sample. [m]
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
