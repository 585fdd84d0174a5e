#pragma once

#include <span>
#include <string_view>

#include "weft/mesh.h"
#include "weft/mesh/edge_uses.h"

namespace weft {

/// Turns triangles over until all that share an edge run along it in opposite directions; the
/// orientation that most triangles of each part have stays. @pre manifold edges
/// @return how many were turned
/// @throws TopologyError naming an edge where that is impossible
int orient_triangles(std::span<Triangle> triangles, const EdgeUses& edges,
                     std::string_view mesh_name);

}  // namespace weft
