#pragma once

#include <span>
#include <vector>

#include "weft/garment.h"
#include "weft/grid.h"
#include "weft/simulation.h"

namespace weft {

/// Rolls up panels that are sewn to themselves across most of their width, as sleeves, cuffs and
/// waistbands of one piece are: a tube with a gap between the edges that meet, its inner side in,
/// round the body that is behind or before the panel, turned to be near what it is sewn to. Flat,
/// their edges would come together in their own plane and crush what is between. A panel stays flat
/// where no tube is free of bodies.
/// @param placed  samples of the panels [n x n] [m]
/// @return of each panel, whether it was rolled up
std::vector<char> roll_up_panels(const Garment& garment, std::span<const PlacedBody> bodies,
                                 Planes3& placed);

}  // namespace weft
