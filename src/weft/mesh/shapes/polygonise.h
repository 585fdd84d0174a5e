#pragma once

#include "weft/mesh.h"
#include "weft/mesh/shapes/field.h"

namespace weft {

/// The surface field = 0 by marching tetrahedra: every cube of a grid is cut into six tetrahedra
/// around its main diagonal, so that cubes fit together and the result is always a closed, oriented
/// 2-manifold (Doi and Koide 1991). Triangles are uneven: see remesh.h.
/// @param box   holds the surface with a margin of a cell
/// @param cell  side of the grid's cubes [m]
TriangleMesh polygonise(const Field& field, const Box3d& box, double cell);

}  // namespace weft
