#pragma once

#include <cstdint>
#include <string>

#include "weft/colliders.h"

namespace weft {

/// Crossing pairs of triangles of cloths alone.
std::int64_t tangled_pairs(const IntersectionCounts& counts);
std::string tangle_text(const IntersectionCounts& counts);

}  // namespace weft
