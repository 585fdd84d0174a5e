#pragma once

#include <string>

#include "weft/run.h"

namespace weft {

/// What makes a run the one that it is, as JSON: the scene with every key but the number of frames,
/// surfaces by a hash of the samples that they became and animations by one of their bytes (so that
/// a changed file is another scene, a moved one is not), and what is recorded.
std::string run_identity(const Scene& scene, const Simulation& simulation,
                         const RunOptions& options);

/// The first key by which two identities differ, with both values; empty when they are the same.
std::string identity_difference(const std::string& found, const std::string& wanted);

}  // namespace weft
