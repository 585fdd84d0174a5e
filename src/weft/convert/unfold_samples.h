#pragma once

#include <vector>

#include "weft/param/square_map.h"
#include "weft/progress.h"

namespace weft {

/// Finds places for the samples of a chart at which its image has fewer triangles that are the
/// wrong way round. A valid map has none, but where it turns sharply between samples, as around the
/// end of a cut, straight edges between them cut corners and fold over each other. Interior samples
/// of such spots and around them slide over the surface; where that does not mend a spot it is
/// left as it was.
/// @param progress  of this alone, may be null
/// @return [rows * cols] in the map's units, see SquareMap::sample_places; empty: all stay
std::vector<Vec2d> unfolded_places(const MappedDisk& mapped, Progress* progress = nullptr);

}  // namespace weft
