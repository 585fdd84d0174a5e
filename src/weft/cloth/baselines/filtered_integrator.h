#pragma once

#include "weft/cloth/baselines/filtered_forces.h"
#include "weft/cloth/integrator.h"

namespace weft {

/// What filtering methods share [desbrun99, zink07]: the accelerations that springs give are
/// filtered, gravity is added to them unfiltered, and with nothing pinned a rigid acceleration
/// takes back what the filter gave to the cloth as a whole.
class FilteredIntegrator : public Integrator {
 public:
  void begin(const StepInput& input, const ClothState& state) noexcept final;
  /// Contacts are left to what the collider does with the proposal.
  ClothState& proposal() noexcept final { return next_; }
  ClothState& iterate(std::span<const Contact> /*contacts*/) noexcept final { return next_; }
  StepReport end(ClothState& state) noexcept final;
  /// A material's bending is none of the springs that are filtered.
  [[nodiscard]] std::string caution() const override;

 protected:
  FilteredIntegrator(const Cloth& cloth, ThreadTeam& team);

  /// Called before a step, by one thread: what depends on the set of pins is renewed.
  virtual void renew() {}
  /// Fills `filtered` from `acceleration`, mates alike. To be called by every worker, after a
  /// barrier; a worker reads no more than its own rows of `filtered` before the next one.
  virtual void filter(const Planes3& acceleration, Planes3& filtered, Worker& worker) = 0;
  /// What is added to the filtered accelerations before they move velocities, and positions alone.
  struct Corrections {
    RigidAcceleration both, position;
  };
  [[nodiscard]] virtual Corrections corrections(const Moments& moments, double time_step) const;

  /// Mates get their mean. Begins and ends with a barrier where there are any.
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
