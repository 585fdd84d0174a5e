#include "weft/collide/contacts/response.h"

#include <algorithm>

namespace weft {

void respond(const Push& push, double time_step, StruckParticle& particle) noexcept {
  const Vec3d n = push.normal;
  particle.position += push.depth * n;
  const double inward = dot(particle.velocity, n);
  if (inward < 0) particle.velocity -= inward * n;

  const Vec3d moved = particle.position - particle.start;
  const Vec3d slid = moved - dot(moved, n) * n;
  const double slid_length = length(slid);
  if (slid_length > 0) particle.position -= std::min(1.0, push.hold / slid_length) * slid;

  const Vec3d along = particle.velocity - dot(particle.velocity, n) * n;
  const double speed = length(along);
  if (speed > 0) particle.velocity -= std::min(1.0, push.hold / (time_step * speed)) * along;
}

}  // namespace weft
