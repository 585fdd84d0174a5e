#pragma once

#include "weft/cloth/baselines/safe_velocities.h"
#include "weft/cloth/baselines/strain_passes.h"

namespace weft {

struct LimitOptions {
  int passes = 10;
  double strain = 0;  ///< largest elongation; 0: the material's, and none where that is 0 too
  /// As the paper's method has it [zink07]: shear springs are limited too, and all of them against
  /// shortening; velocities change by whole corrections over h. This makes energy.
  bool as_printed = false;
};

/// The largest elongation that stands; 0: there is no limit.
double strain_limit_of(const LimitOptions& options, const Material& material);

/// Provot's limit [provot95]: stretch springs longer than r (1 + e), e the largest elongation, move
/// both ends towards each other along the spring, by inverse mass, so that exactly the limit
/// stands; velocities change by the same over h, as far as that lends the cloth no kinetic energy
/// (see SafeVelocities). What is shorter than at rest may be: cloth buckles. Springs in a fixed
/// colouring, so any team gives the same bits; pins stay; mates stay equal.
class StrainLimit {
 public:
  /// @param cloth  kept by reference
  StrainLimit(const Cloth& cloth, const ThreadTeam& team);

  void limit(const LimitOptions& options, double time_step, ClothState& state,
             ThreadTeam& team) noexcept;

 private:
  void limit_safely(int passes, const StrainBounds& bounds, ClothState& state, Worker& worker);

  const Cloth& cloth_;
  StrainPasses passes_;
  SafeVelocities velocities_;
  Planes3 correction_;  // [n x n] of positions, zero between calls [m]
};

/// Limits once, with a StrainLimit of its own.
void limit_strain(const Cloth& cloth, const LimitOptions& options, double time_step,
                  ClothState& state, ThreadTeam& team);

}  // namespace weft
