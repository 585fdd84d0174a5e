#pragma once

#include "weft/cloth/cloth.h"
#include "weft/cloth/integrator.h"
#include "weft/core/stopwatch.h"

namespace weft {

/// Copies this worker's rows.
void copy_rows(const ClothState& from, ClothState& to, Worker& worker);

/// Puts every pinned sample at its target, with the velocity that takes it there in one step.
void set_pins(const Cloth& cloth, const ClothState& start, double time_step, ClothState& next);

/// Copies a proposal to the state, mates made equal but where seams are being sewn. Pins keep their proposed positions: a filter
/// may have stopped them before their targets.
void accept(const Cloth& cloth, ClothState& next, ClothState& state, ThreadTeam& team);

}  // namespace weft
