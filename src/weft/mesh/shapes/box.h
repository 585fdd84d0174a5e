#pragma once

#include "weft/mesh.h"

namespace weft {

/// A closed box around the origin with sharp edges, in squares of 2 cm cut in two.
TriangleMesh box_mesh();
/// [m]
inline constexpr Vec3d box_size{0.6, 0.4, 0.5};

}  // namespace weft
