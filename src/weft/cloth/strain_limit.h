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

/// How long springs may be, in rest lengths.
struct StrainBounds {
  float shortest = 1, longest = 1;
  float inverse_step = 0;  ///< velocities change by the corrections times this [1/s]
};
/// One pass over the stretch and shear springs, to be called by every worker. Ends with a barrier;
/// mates are left behind their representatives.
void limit_pass(const Cloth& cloth, const StrainBounds& bounds, ClothState& state,
                Worker& worker) noexcept;

}  // namespace weft
