#pragma once

#include "weft/cloth/cloth.h"
#include "weft/core/thread_team.h"

namespace weft {

/// The largest step [s] at which explicit Euler in symplectic order stays bounded, for small
/// motions about the rest shape: h^2 w^2 + 2 h c < 4, with w the highest frequency (by power
/// iteration) and c a bound of the damping rate. Stretched springs stiffen the cloth, so the step
/// that a run bears is somewhat smaller.
double largest_stable_step(const Cloth& cloth, ThreadTeam& team);

/// Whether a step is stable already by Gershgorin's bound on w, for a small part of the work. It
/// decides nearly always for steps of half the largest and less.
bool is_surely_stable(const Cloth& cloth, double time_step);

}  // namespace weft
