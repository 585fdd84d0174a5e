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
  double drift = 0;    ///< part of kinetic: that of the mean velocity
  [[nodiscard]] double total() const { return kinetic + elastic + gravity; }
  /// Kinetic and elastic energy, which do not depend on where the cloth is.
  [[nodiscard]] double own() const { return kinetic + elastic; }
  /// own() less drift, which is the same in every frame of uniform motion.
  [[nodiscard]] double inner() const { return kinetic - drift + elastic; }
  Energy& operator+=(const Energy& other) {
    kinetic += other.kinetic;
    elastic += other.elastic;
    gravity += other.gravity;
    drift += other.drift;
    return *this;
  }
};

/// Measures the energy of one cloth, as kinetic_energy and potential_energy do. Kernels sum rows in
/// fixed lanes of single precision, and the rows are added in order in double, so any team and
/// instruction set gives the same bits.
class EnergyMeter {
 public:
  /// @param cloth     kept by reference, as is the team
  /// @param stiffens  whether springs stiffen beyond the material's strain limit
  EnergyMeter(const Cloth& cloth, Vec3d gravity, ThreadTeam& team, bool stiffens = false);

  Energy measure(const ClothState& state) noexcept;
  double kinetic(const Planes3& velocity) noexcept;
  [[nodiscard]] double mass() const { return total_mass_; }  ///< [kg]
  /// Removes kinetic energy by scaling the velocities relative to their mean, so that momentum is
  /// kept.
  /// @param energy  to remove [J]
  /// @return energy removed [J]
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
  bool stiffens_;
  RowSums sums_;
};

}  // namespace weft
