#pragma once

#include "weft/grid.h"

namespace weft {

/// Positions and velocities of a cloth's samples. Mates hold equal bits.
struct ClothState {
  Planes3 position;  ///< [m]
  Planes3 velocity;  ///< [m/s]
};

/// Strain |l / r - 1| over the stretch springs; seam springs count once.
struct StrainSummary {
  double mean = 0, p99 = 0, max = 0;
};

}  // namespace weft
