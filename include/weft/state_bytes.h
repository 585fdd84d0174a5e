#pragma once

#include <string>
#include <string_view>

#include "weft/simulation.h"

namespace weft {

/// The state as bytes, for files and other processes; little-endian, for this version of Weft.
std::string encode_state(const SimulationState& state);

/// The state of such bytes, to the same bits. Whether it fits a simulation, their user knows.
/// @param where  for errors
/// @throws InputError for bytes that are damaged, cut short, of another version or no state
SimulationState decode_state(std::string_view bytes, const std::string& where);

}  // namespace weft
