#pragma once

#include "weft/cloth/cloth.h"
#include "weft/cloth/kernels/kernel_table.h"
#include "weft/core/ordered_sum.h"
#include "weft/core/thread_team.h"

namespace weft {

/// Adds changes to velocities so that they lend a cloth no kinetic energy K: of a change c the part
/// f c, f the largest in [0, 1] with K(v + f c) <= K(v). With K(v + f c) = K(v) + f b + f^2 a,
///   b = sum m v . c,  a = sum m |c|^2 / 2,  f = min(1, max(0, -b / a)),
/// particles counted once. One factor for all keeps the momentum that c has none of. Sums in a
/// fixed order, so any team and instruction set gives the same bits.
class SafeVelocities {
 public:
  /// @param cloth  its masses are taken; kept by reference
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

}  // namespace weft
