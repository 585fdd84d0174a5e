#pragma once

#include "weft/core/random.h"
#include "weft/mesh.h"

namespace weft::test {

inline bool chance(Random& random, double probability) { return random.uniform() < probability; }

// What random meshes begin with.

/// A flat rectangle of unit squares.
TriangleMesh patch(int rows, int cols);
/// Cubes with gaps (handles) and open tops (holes), of about so many triangles.
TriangleMesh slab(Random& random, double triangles);
/// Where a few random waves cancel, inside a ball: a closed surface with handles.
TriangleMesh waves(Random& random, double triangles);

}  // namespace weft::test
