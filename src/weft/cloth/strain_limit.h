#pragma once

#include "weft/cloth/cloth.h"
#include "weft/core/thread_team.h"

namespace weft {

struct LimitOptions {
  int passes = 10;
};
/// Provot's limit [provot95]: stretch and shear springs longer than r (1 + e) or shorter than r (1
/// - e), e the material's strain limit, move both ends towards each other (or apart) along the
/// spring, by inverse mass, so that exactly the limit stands; velocities change by the same over h.
/// Springs in a fixed colouring, so any team gives the same bits; pins stay; mates stay equal.
void limit_strain(const Cloth& cloth, const LimitOptions& options, double time_step,
                  ClothState& state, ThreadTeam& team) noexcept;

}  // namespace weft
