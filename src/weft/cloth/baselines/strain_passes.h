#pragma once

#include <cstdint>
#include <vector>

#include "weft/cloth/cloth.h"
#include "weft/cloth/kernels/kernel_table.h"
#include "weft/core/thread_team.h"

namespace weft {

/// How long springs may be, in rest lengths.
struct StrainBounds {
  float shortest = 0, longest = 1;
  float inverse_step = 1;   ///< changes are the corrections times this
  bool as_printed = false;  ///< shear springs too; corrections are over-relaxed
};

/// The positions that corrections move, and their sum.
struct LimitedMotion {
  Planes3 &position, &change;  ///< [n x n] mates do not follow their representative
};

/// Passes over the springs that move both ends of those that are out of bounds, by inverse mass.
/// Springs are taken in a fixed colouring, so any team gives the same bits; pins stay.
///
/// A stiff method leaves few springs to limit, mostly around pins: after the first pass only the
/// blocks of a row that the pass before changed, and those beside them, are visited. As printed,
/// corrections are over-relaxed from the second pass on.
class StrainPasses {
 public:
  /// @param cloth  size, mates, inverse masses and springs; kept by reference
  StrainPasses(const Cloth& cloth, const ThreadTeam& team);

  /// To be called by every worker; ends with a barrier.
  /// @return whether any spring was limited, the same for every worker
  bool run(int count, const StrainBounds& bounds, const LimitedMotion& motion,
           Worker& worker) noexcept;

 private:
  struct Sweep;
  [[nodiscard]] int changed_blocks() const;
  void renew_active();
  [[nodiscard]] Range columns_of(int first_block, int last_block) const;
  void limit_run(LimitedRows rows, Range blocks, int row);
  void pass(const Sweep& sweep);
  void limit_colour(const Sweep& sweep, int direction, int parity);
  void limit_border(const Sweep& sweep);
  [[nodiscard]] LimitedRows join(const Sweep& sweep, const SpringPlane& springs, int row) const;

  const Cloth& cloth_;
  const KernelTable* kernels_;
  int first_;  // first row and column of coloured springs: 1 with mates, else 0
  int block_;  // columns; a row has at most 64
  // One bit a block, by the samples that springs start from.
  std::vector<std::uint64_t> active_;   // [n] blocks to visit
  std::vector<std::uint64_t> changed_;  // [n] blocks with limited springs
};

}  // namespace weft
