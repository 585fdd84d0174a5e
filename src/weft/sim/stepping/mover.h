#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "weft/cloth/baselines/coarse_limit.h"
#include "weft/cloth/baselines/strain_limit.h"
#include "weft/cloth/energy_meter.h"
#include "weft/cloth/integrator.h"
#include "weft/cloth/wind.h"
#include "weft/sim/stepping/driven_work.h"
#include "weft/sim/stepping/runaway.h"

namespace weft {

/// The integrator, limiters and meters of one cloth, with their results of the current step.
struct Mover {
  std::unique_ptr<Integrator> integrator;
  std::optional<Wind> wind;
  RunawayCheck runaway;
  StrainLimit limit;
  std::optional<CoarseLimit> coarse_limit;  ///< of soft springs
  EnergyMeter meter;
  DrivenWork driven_work;
  /// Energies of this step: at its start, after the air; after solve and strain limit; at its end.
  Energy start, solved, end;
  Planes3 calm_velocity;     // velocities before air and seams [m/s]
  Planes3 guess;             // filtered positions before the solve [m]
  double unsewn_energy = 0;  // before a step in which seams are pulled together [J]
  // Of this step: work of the air, energy added by the strain limit while something pulled. [J]
  double air_work = 0, pulled_work = 0;
  std::vector<Contact> contacts{};  // those between open seams after those that the collider found
  bool limited = false;             // a strain limiter works on the proposals of this step
};

}  // namespace weft
