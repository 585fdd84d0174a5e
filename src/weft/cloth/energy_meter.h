#pragma once

#include "weft/cloth/bending.h"
#include "weft/cloth/cloth.h"
#include "weft/core/ordered_sum.h"
#include "weft/core/thread_team.h"

namespace weft {

/// The energy of a cloth, by its kinds. [J]
struct Energy {
  double kinetic = 0;
  double elastic = 0;  ///< springs and bending
  double gravity = 0;  ///< zero at the origin
  double drift = 0;    ///< of the kinetic: what the mean velocity alone would have
  [[nodiscard]] double total() const { return kinetic + elastic + gravity; }
  /// What motion and shape hold, wherever the cloth is.
  [[nodiscard]] double own() const { return kinetic + elastic; }
  /// What of that can come to act within the cloth: the same in every uniform flight.
  [[nodiscard]] double inner() const { return kinetic - drift + elastic; }
  Energy& operator+=(const Energy& other) {
    kinetic += other.kinetic;
    elastic += other.elastic;
    gravity += other.gravity;
    drift += other.drift;
    return *this;
  }
};

/// Measures the energy of one cloth in every step: what kinetic_energy and potential_energy give,
/// rows summed in fixed lanes of single precision by kernels and added in their order in double,
/// to the same bits for any team and instruction set.
class EnergyMeter {
 public:
  /// @param cloth  kept by reference, as is the team
  EnergyMeter(const Cloth& cloth, Vec3d gravity, ThreadTeam& team);

  Energy measure(const ClothState& state) noexcept;
  double kinetic(const Planes3& velocity) noexcept;
  [[nodiscard]] double mass() const { return total_mass_; }  ///< [kg]
  /// Takes energy out of a motion by slowing what differs from its mean velocity, so that momentum
  /// stays. @param energy  [J] @return what it could take [J]
  double take_out(double energy, Planes3& velocity) noexcept;

 private:
  [[nodiscard]] double spring_row(const Planes3& position, int row) const;

  const Cloth& cloth_;
  ThreadTeam& team_;
  const KernelTable& kernels_;
  BendingPass bending_;
  Grid<float> mass_;     // [n x n] of representatives, else 0 [kg]
  Grid<float> gravity_;  // [3 x n] its components, in every column [m/s^2]
  Grid<float> axes_;     // [2 x n] zeros, ones
  double total_mass_ = 0;
  RowSums sums_;
};

}  // namespace weft
