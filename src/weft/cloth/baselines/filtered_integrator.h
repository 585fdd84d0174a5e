#pragma once

#include "weft/cloth/baselines/filtered_forces.h"
#include "weft/cloth/integrator.h"

namespace weft {

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
