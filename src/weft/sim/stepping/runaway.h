#pragma once

#include <optional>
#include <vector>

#include "weft/cloth/cloth.h"
#include "weft/cloth/kernels/kernel_table.h"
#include "weft/cloth/measure.h"
#include "weft/core/thread_team.h"

namespace weft {

/// Detects runaway motion by a bound on the kinetic energy per mass that a cloth can have gained.
class RunawayCheck {
 public:
  /// @param start  the state that the run begins with
  /// @param drive  the speed that wind or moving pins may lend [m/s]
  RunawayCheck(const Cloth& cloth, const ClothState& start, Vec3d gravity, double drive = 0);

  /// The first particle that is not finite; else the fastest one, when the cloth has more kinetic
  /// energy per mass than `max_energy` or a single particle moves at ten times the speed of that.
  [[nodiscard]] std::optional<BadParticle> find(const Cloth& cloth, const ClothState& state,
                                                double seconds, ThreadTeam& team);

  /// A hundred times the energy per mass that a fall of `seconds` and of the cloth's own size
  /// accounts for. [J/kg]
  [[nodiscard]] double max_energy(double seconds) const;

 private:
  [[nodiscard]] bool suspect(const Cloth& cloth, const ClothState& state, double bound,
                             ThreadTeam& team);

  std::vector<RowMotion> rows_;
  double mass_ = 0;                                                // [kg]
  double start_energy_ = 0, speed_ = 0, gravity_ = 0, reach_ = 0;  // [J/kg], [m/s], [m/s^2], [m]
};

/// The fastest particle, for error messages.
BadParticle fastest_particle(const Cloth& cloth, const ClothState& state);

}  // namespace weft
