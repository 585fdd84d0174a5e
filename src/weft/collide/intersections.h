#pragma once

#include <array>
#include <vector>

#include "weft/core/planes.h"
#include "weft/mesh/triangle_mesh.h"

namespace weft {

/// A triangulated grid at one moment.
struct GridTriangles {
  const Planes3* positions = nullptr;                ///< [n x n] world [m]
  const std::vector<Triangle>* triangles = nullptr;  ///< corners as samples
};

/// How many pairs of triangles, one of each surface, cross each other: an edge of one passes
/// through the inside of the other. Doubles; touching and coplanar pairs do not count. Pairs are
/// found through a lattice of boxes.
int count_intersections(const GridTriangles& a, const GridTriangles& b);

/// True when an edge of one passes through the other.
bool triangles_cross(const std::array<Vec3d, 3>& a, const std::array<Vec3d, 3>& b);

}  // namespace weft
