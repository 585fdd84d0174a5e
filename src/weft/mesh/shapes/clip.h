#pragma once

#include "weft/mesh.h"
#include "weft/mesh/shapes/field.h"

namespace weft {

/// The part of a mesh where a field is negative; triangles on its edge are cut, their new vertices
/// where the field, taken as linear along edges, vanishes. Vertices that are left over are dropped.
TriangleMesh clip(const TriangleMesh& mesh, const Field& cut);

}  // namespace weft
