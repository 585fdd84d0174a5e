#pragma once

#include <cstdint>
#include <string>

#include "weft/sim/scene.h"

namespace weft {

/// About how much memory a run takes at most, by the sizes in the scene: within a quarter for
/// scenes of 257 samples a side and more. Converting a mesh first takes some hundred bytes a
/// triangle, which is not in it. Reads the geometry images among the surfaces. @throws InputError
/// for these
/// @return bytes
std::uint64_t estimate_memory(const Scene& scene);

/// Refuses what can certainly not run.
/// @param bytes      of the estimate
/// @param available  see available_memory
/// @throws SceneError when the estimate, wrong by a quarter, is still more
void check_memory(std::uint64_t bytes, std::uint64_t available, const std::string& scene);

/// Whether a run may be short of memory by the estimate: more than four fifths of what is there.
bool is_memory_short(std::uint64_t bytes, std::uint64_t available);

/// For people: "1.3 GB", "45 MB". MB of 10^6 bytes.
std::string memory_text(std::uint64_t bytes);

}  // namespace weft
