#pragma once

#include "weft/core/planes.h"
#include "weft/image/geometry_image.h"

namespace weft {

/// The normals that a surface has where it moved to, from those it had: each texel's is turned and
/// sheared as the samples around it were (by the inverse transpose of the map of their tangents and
/// normal), so that what is finer than the samples stays on it. The grid's own normals are taken
/// where it has no area, before or after.
/// @param rest     [n x n] where the surface was [m], finite
/// @param normals  [k x k] of the surface there, any size k >= 2
/// @param moved    [n x n] where it is [m], finite
/// @throws UsageError when the grids differ in size
NormalMap carried_normals(const Planes3& rest, const NormalMap& normals, const Planes3& moved);

}  // namespace weft
