#pragma once

#include "weft/cloth/cloth.h"
#include "weft/cloth/kernels/implicit_kernels.h"
#include "weft/core/instruction_set.h"

namespace weft {

/// Forces of all springs on the particles of one row: each sample gathers from its neighbours, so
/// no write is shared between rows. A sample of a class gets its own part; the class's force is the
/// sum over it. With l = x_j - x_i the force on i is k (|l| - r) l / |l| [provot95; the sign there
/// is a slip].
class SpringForces {
 public:
  /// @param cloth  kept by reference
  explicit SpringForces(const Cloth& cloth, InstructionSet instructions = best_instruction_set());

  /// Elastic forces alone.
  /// @param position  [n x n] [m]
  /// @param force     [n x n] row `row` is overwritten [N]
  void gather_elastic(int row, const Planes3& position, Planes3& force) const;

  /// Elastic forces and damping: c times the relative velocity along the spring, so that neither
  /// free fall nor turning as a whole is slowed.
  void gather_damped(int row, const ClothState& state, Planes3& force) const;

 private:
  const Cloth& cloth_;
  const ImplicitKernels& kernels_;
};

}  // namespace weft
