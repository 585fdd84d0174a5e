#pragma once

#include "weft/core/random.h"
#include "weft/vec.h"

namespace weft::test {

/// A point of the cube [-half, half]^3; its coordinates are drawn in the order x, y, z.
inline Vec3d random_point(Random& random, double half = 1) {
  return {random.uniform(-half, half), random.uniform(-half, half), random.uniform(-half, half)};
}

}  // namespace weft::test
