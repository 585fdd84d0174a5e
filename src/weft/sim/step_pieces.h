#pragma once

#include "weft/cloth/cloth.h"
#include "weft/core/planes.h"
#include "weft/core/vec.h"

namespace weft {

/// Bodies go at most this part of the least gap in a step where cloth is near, so that cloth is
/// pushed before it is passed: faster ones take more steps.
inline constexpr double most_way_in_gaps = 0.75;
/// Of a substep.
inline constexpr int most_pieces = 64;

/// What a cloth sweeps as it flies on, and somewhat more. @param padding  [m]
Box3d swept_box(const ClothState& cloth, double seconds, double padding) noexcept;

/// The farthest that any sample goes. [m]
double farthest_way(const Planes3& from, const Planes3& to) noexcept;

/// The farthest that any sample goes whose way comes into a box. [m]
double farthest_way(const Planes3& from, const Planes3& to, const Box3d& box) noexcept;

/// Into how many pieces, a power of 2, a substep is split in which bodies go so far.
/// @param most  that they may go in a step [m], > 0
int pieces_for(double way, double most) noexcept;

}  // namespace weft
