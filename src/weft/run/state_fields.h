#pragma once

#include <optional>

#include "weft/run/bytes.h"
#include "weft/simulation.h"

namespace weft {

/// Appends a state, field by field, as checkpoints and saved states hold it.
void add_state(const SimulationState& state, ByteWriter& out);

/// Reads a state; nothing when its fields are inconsistent, as in no bytes that Weft wrote.
std::optional<SimulationState> next_state(ByteReader& in);

}  // namespace weft
