#pragma once

#include "weft/grid.h"

namespace weft {

/// What moves. Mates hold equal bits.
struct ClothState {
  Planes3 position;  ///< [m]
  Planes3 velocity;  ///< [m/s]
};

/// |l / r - 1| over the stretch springs (a seam spring once).
struct StrainSummary {
  double mean = 0, p99 = 0, max = 0;
};

}  // namespace weft
