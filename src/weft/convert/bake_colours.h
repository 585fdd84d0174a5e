#pragma once

#include "weft/convert.h"

namespace weft {

/// Samples the colours of a mesh in the square of its image: a map as fine as pictures ask for, and
/// its means as the image's own colours, mates joined.
/// @param given  the mesh that `made` was converted from, whose triangles the colours count
/// @throws UsageError for colours of another number of triangles
void bake_colours(const TriangleMesh& given, const SurfaceColours& colours, Conversion& made);

}  // namespace weft
