#pragma once

#include "weft/cloth/cloth.h"
#include "weft/core/thread_team.h"

namespace weft {

/// A spring shorter than the square root of this [m] has no direction and pulls nowhere.
inline constexpr float least_squared_length = 1e-30F;

// Forces of all springs on the particles of one row: each sample gathers from its twelve
// neighbours, so no write is shared between rows. A sample of a class gets its own part; the
// class's force is the sum over it. With l = x_j - x_i the force on i is k (|l| - r) l / |l|
// [provot95; the sign there is a slip].

/// Elastic forces alone.
/// @param position  [n x n] [m]
/// @param force     [n x n] row `row` is overwritten [N]
void gather_elastic(const Cloth& cloth, int row, const Planes3& position, Planes3& force);

/// Elastic forces and damping: c times the relative velocity along the spring, so that neither free
/// fall nor turning as a whole is slowed.
void gather_damped(const Cloth& cloth, int row, const ClothState& state, Planes3& force);

}  // namespace weft
