#pragma once

#include "weft/vec.h"

namespace weft {

/// One particle during a step, for the response to an obstacle.
struct StruckParticle {
  Vec3d start;     ///< at the start of the step [m]
  Vec3d position;  ///< proposed [m]
  Vec3d velocity;  ///< proposed [m/s]
};

/// What strikes it.
struct Push {
  Vec3d normal;      ///< unit, out of the obstacle
  double depth = 0;  ///< how far the particle has to move along the normal, >= 0 [m]
  double hold = 0;   ///< tangential motion that friction may take: the coefficient times the depth
                     ///< of the step [m]
};

/// Moves the particle out, stops its velocity into the obstacle, and takes back as much of the
/// tangential motion of this step as friction may: at most `hold`, all of it when it was less
/// (sticking). The velocity loses the same over the time step, never turning round.
void respond(const Push& push, double time_step, StruckParticle& particle) noexcept;

}  // namespace weft
