#pragma once

#include <array>

#include "weft/cloth/cloth.h"
#include "weft/cloth/kernels/filtering_kernels.h"
#include "weft/core/thread_team.h"

namespace weft {

/// Springs that pull along themselves and resist all relative velocity of their ends by c (v_j -
/// v_i), as those of a filter do: implicit Euler adds c = h k to first order [desbrun99]. Rest
/// lengths are the cloth's.
class ViscousSprings {
 public:
  /// Without stiffness as yet.
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

}  // namespace weft
