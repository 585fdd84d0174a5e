#pragma once

#include <array>
#include <vector>

#include "weft/cloth/cloth.h"
#include "weft/cloth/integrator.h"
#include "weft/cloth/kernels/filtering_kernels.h"
#include "weft/core/thread_team.h"

namespace weft {

/// Moments of a field of accelerations: sums over particles, each once, with x the vector from a
/// point near them.
struct Moments {
  Vec3d about;                                            ///< [m]
  double mass = 0;                                        ///< [kg]
  Vec3d first;                                            ///< sum m x [kg m]
  Vec3d force, torque;                                    ///< sum m a [N], sum x cross m a [N m]
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;  ///< sum m x x^T [kg m^2]
};

/// A rigid acceleration: linear + r cross turn, r from the centre.
struct RigidAcceleration {
  Vec3d centre, linear, turn;
};

/// The rigid acceleration that restores net force and net torque after a filter. Those of internal
/// forces are zero, which filters do not keep:
///   linear = -F / m,  turn = I^-1 T,  T = sum r x m a,  I = sum m (|r|^2 1 - r r^T)
/// so that a + linear + r x turn has no net force and no net torque. (The printed formula lacks
/// I^-1.)
RigidAcceleration momentum_correction(const Moments& moments);

/// The paper's torque correction as printed: x_i += (x_G - x_i) x (dT h) h^2 / m, dT = sum f x x,
/// as the acceleration that moves x so.
RigidAcceleration printed_correction(const Moments& moments, double time_step, double mass);

/// Moments of accelerations `a` at positions `x` about the middle sample, to the same bits for any
/// team and instruction set: rows are summed in fixed lanes of single precision, which is enough
/// near the particles, and added in their order in double.
class MomentSums {
 public:
  MomentSums(int size, const ThreadTeam& team)
      : kernels_(filtering_kernels_for(team.instructions())),
        rows_(static_cast<std::size_t>(size)) {}
  /// To be called by every worker; ends with a barrier, all get the same.
  Moments sum(const Cloth& cloth, const Planes3& x, const Planes3& a, Worker& worker);

 private:
  const FilteringKernels& kernels_;
  std::vector<std::array<double, moment_terms>> rows_;
};

/// Springs that pull along themselves and resist all relative velocity of their ends by
/// c (v_j - v_i), like the springs of a filter: implicit Euler adds c = h k to first order
/// [desbrun99]. Rest lengths are the cloth's.
class ViscousSprings {
 public:
  /// All stiffnesses are 0 at first.
  /// @param cloth  kept by reference
  ViscousSprings(const Cloth& cloth, const ThreadTeam& team);

  std::array<Grid<float>, spring_directions> stiffness;  ///< [n x n] each, k [N/m], >= 0
  std::array<Grid<float>, spring_directions> viscosity;  ///< [n x n] each, c [N s/m], >= 0

  /// Forces of all springs on the particles of one row. Each sample gathers from its twelve
  /// neighbours, so no write is shared between rows; a sample of a class gets its own part.
  /// @param force  [n x n] row `row` is overwritten [N]
  void gather_row(int row, const ClothState& state, Planes3& force) const;

 private:
  const Cloth& cloth_;
  const FilteringKernels& kernels_;
};

/// The common part of filtering methods [desbrun99, zink07]: the accelerations by springs are
/// filtered, gravity is added to them unfiltered, and without pins a rigid acceleration removes the
/// net force and torque that the filter adds.
class FilteredIntegrator : public Integrator {
 public:
  void begin(const StepInput& input, const ClothState& state) noexcept final;
  ClothState& proposal() noexcept final { return next_; }
  /// Ignores contacts, which the collider resolves in the proposal.
  ClothState& iterate(std::span<const Contact> /*contacts*/) noexcept final { return next_; }
  StepReport end(ClothState& state) noexcept final;
  /// Warns of a material's bending, which is not among the filtered springs.
  [[nodiscard]] std::string caution() const override;

 protected:
  FilteredIntegrator(const Cloth& cloth, ThreadTeam& team);

  /// Renews what depends on the set of pins. Called before a step, by one thread.
  virtual void renew() {}
  /// Fills `filtered` from `acceleration`, mates alike. To be called by every worker, after a
  /// barrier; a worker reads no more than its own rows of `filtered` before the next one.
  virtual void filter(const Planes3& acceleration, Planes3& filtered, Worker& worker) = 0;
  /// Rigid accelerations added to the filtered ones: `both` moves velocities and positions,
  /// `position` moves positions alone.
  struct Corrections {
    RigidAcceleration both, position;
  };
  [[nodiscard]] virtual Corrections corrections(const Moments& moments, double time_step) const;

  /// Averages over mates. Begins and ends with a barrier where there are any.
  void average(Planes3& planes, Worker& worker) const;

  const Cloth& cloth_;
  ThreadTeam& team_;
  const FilteringKernels& kernels_;
  ViscousSprings springs_;  ///< to be filled by the method

 private:
  void accelerate(const ClothState& state, Worker& worker);
  void advance(const ClothState& state, Worker& worker);
  void advance_row(const ClothState& state, const Corrections& add, int row);

  Planes3 acceleration_, filtered_;
  ClothState next_;
  MomentSums sums_;
  StepInput input_;
  StepReport report_;
};

}  // namespace weft
