#pragma once

#include <span>

#include "weft/garment.h"
#include "weft/simulation.h"

namespace weft {

/// Moves a garment up or down whose seams would have to close through a body: a pattern is made for
/// a body of its own, and the shoulders of another may lie higher, or its crotch lower. Goes to the
/// nearest height at which bodies are in the way of half as many pairs of its seams, or fewer, as
/// where the pattern places it; where there is none it stays there.
/// @param placed  samples of the panels [n x n] [m]
/// @return by how much it is higher [m]
double move_to_free_height(const Garment& garment, std::span<const PlacedBody> bodies,
                           Planes3& placed);

}  // namespace weft
