#pragma once

#include "weft/collide/broad_phase/candidate_pairs.h"
#include "weft/collide/moving_surface.h"

namespace weft {

/// Whether two cells that share one point certainly meet nowhere else during a step: a plane
/// through that point has the rest of one on one side of it and of the other on the other side,
/// also where every sample leaves its path by up to `slack`. [m] UnfoldedWindows tells the same of
/// most neighbours, but no window holds cells of three or four charts that meet in a corner.
bool apart_at_shared_point(const MovingSurface& surface, const CandidatePair& pair, float slack);

}  // namespace weft
