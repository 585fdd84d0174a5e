#pragma once

#include "weft/cloth/baselines/strain_passes.h"
#include "weft/cloth/cloth.h"
#include "weft/cloth/kernels/kernel_table.h"
#include "weft/core/ordered_sum.h"
#include "weft/core/thread_team.h"

namespace weft {

/// Adds a change to velocities without raising a cloth's kinetic energy K: of a change c the part
/// f c, f the largest in [0, 1] with K(v + f c) <= K(v). With K(v + f c) = K(v) + f b + f^2 a,
///   b = sum m v . c,  a = sum m |c|^2 / 2,  f = min(1, max(0, -b / a)),
/// particles counted once. As f is the same for all, changes without net momentum keep momentum.
/// Sums are in a fixed order, so any team and instruction set gives the same bits.
class SafeVelocities {
 public:
  /// @param cloth  whose masses are used; kept by reference
  SafeVelocities(const Cloth& cloth, const ThreadTeam& team);

  /// To be called by every worker when the change is in place; a worker writes its own rows.
  /// @param change    [n x n] c over the scale; mates equal, or only on representatives
  /// @param scale     [1/s] where the change is one of positions
  /// @param velocity  [n x n] [m/s]
  /// @return f
  double add(const Planes3& change, double scale, Planes3& velocity, Worker& worker);

 private:
  const Cloth& cloth_;
  const KernelTable& kernels_;
  Grid<float> own_mass_;  ///< [n x n] the particle's mass on its representative, else 0 [kg]
  RowSums sums_;
};

struct LimitOptions {
  int passes = 10;
  double strain = 0;  ///< largest elongation; 0: the material's, and none where that is 0 too
  /// As in the paper's method [zink07]: shear springs are limited too, and all of them against
  /// shortening; velocities change by whole corrections over h, which adds energy.
  bool as_printed = false;
};

/// The largest elongation that applies; 0: there is no limit.
double strain_limit_of(const LimitOptions& options, const Material& material);

/// Provot's limit [provot95]: a stretch spring longer than r (1 + e), e just below the largest
/// elongation, moves both ends towards each other along the spring, by inverse mass, to exactly
/// that length. Velocities change by the same over h, as far as that adds no kinetic energy (see
/// SafeVelocities). Springs may be shorter than at rest: cloth buckles. They are taken in a fixed
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
