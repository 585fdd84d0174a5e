#pragma once

#include <span>
#include <vector>

#include "weft/mesh.h"

namespace weft {

/// The other vertices of the triangles around a vertex, ascending, each once.
/// @param triangles  all triangles
/// @param around     indices of those that have the vertex for a corner, in any order
std::vector<int> one_ring(std::span<const Triangle> triangles, std::span<const int> around,
                          int vertex);

}  // namespace weft
