#pragma once

#include "weft/cloth/cloth.h"

namespace weft {

/// The gap that a cloth keeps to obstacles. [m]
double gap_of(const Cloth& cloth);

/// The gap that a cloth keeps to itself and to other cloths. [m]
double self_gap_of(const Cloth& cloth);

}  // namespace weft
