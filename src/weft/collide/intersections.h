#pragma once

#include <vector>

#include "weft/core/planes.h"
#include "weft/mesh/triangle_mesh.h"

namespace weft {

/// A triangulated grid at one moment.
struct GridTriangles {
  const Planes3* positions = nullptr;                ///< [n x n] world [m]
  const std::vector<Triangle>* triangles = nullptr;  ///< corners as samples
};

/// How many pairs of triangles, one of each surface, cross each other (weft/mesh/crossings.h): an
/// exact count for the positions as they are. Touching pairs do not count, pairs that overlap in
/// one plane do. @pre finite positions
int count_intersections(const GridTriangles& a, const GridTriangles& b);

}  // namespace weft
