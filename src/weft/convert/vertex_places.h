#pragma once

#include <span>
#include <vector>

#include "weft/param/square_map.h"

namespace weft {

/// Where the vertices of a mesh lie in the square that it was mapped to, in sample units.
/// @param source_vertex  of each vertex of the repaired mesh, the one that it was in the input
/// @param vertices       how many the input has
/// @return [vertices] of several places (on the cut, or where fans were split) the first; not
/// finite for vertices that the repaired mesh has not
std::vector<Vec2d> vertex_places(const MappedDisk& mapped, std::span<const int> source_vertex,
                                 int vertices);

}  // namespace weft
