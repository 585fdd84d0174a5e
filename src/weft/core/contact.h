#pragma once

#include "weft/core/vec.h"

namespace weft {

/// A half-space that one particle must not enter, found by a collider and heeded by an integrator,
/// which do not know each other: dot(normal, position) >= offset.
struct Contact {
  int sample = 0;          ///< row * n + col of the particle
  Vec3f normal;            ///< unit, away from the obstacle
  float offset = 0;        ///< [m]
  float friction = 0;      ///< Coulomb coefficient of the pair
  Vec3f surface_velocity;  ///< of the obstacle there [m/s]
};

}  // namespace weft
