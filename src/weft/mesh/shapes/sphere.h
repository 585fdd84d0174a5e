#pragma once

#include "weft/mesh.h"

namespace weft {

/// An icosahedron whose triangles are split in four `levels` times (20 * 4^levels triangles), every
/// vertex on the sphere around the origin.
/// @param radius  [m], > 0
/// @param levels  >= 0
TriangleMesh icosphere(double radius, int levels);

}  // namespace weft
