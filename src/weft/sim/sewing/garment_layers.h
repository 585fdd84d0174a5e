#pragma once

#include <span>

#include "weft/geometry_image.h"
#include "weft/grid.h"

namespace weft {

/// A garment that is worn below another, where it begins. Both are kept by reference.
struct GarmentBelow {
  const BorderMates& mates;  ///< its charts are its panels
  const Planes3& placed;     ///< [n x n] [m]
};

/// Moves the panels of a garment outwards, each along its outer side, so that it closes round those
/// that are worn below it: by 5 cm for each of these at least, and until every panel is 5 cm
/// outside those below that face the same way behind it.
/// @param layer   from 0, the innermost  @param placed  samples of the panels [n x n] [m]
void put_round_layers(const BorderMates& mates, int layer, std::span<const GarmentBelow> below,
                      Planes3& placed);

}  // namespace weft
