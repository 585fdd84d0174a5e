#pragma once

#include <string>

#include "weft/run.h"

namespace weft {

/// Identity of a run as JSON: the scene with every key but the number of frames, with surfaces
/// replaced by hashes of their samples and animations by hashes of their bytes (so that a changed
/// file is another scene, a moved one is not), and what is recorded.
std::string run_identity(const Scene& scene, const Simulation& simulation,
                         const RunOptions& options);

/// The first key by which two identities differ, with both values; empty when they are the same.
std::string identity_difference(const std::string& found, const std::string& wanted);

}  // namespace weft
