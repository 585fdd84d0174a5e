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

/// What corrections move, and what adds them up.
struct LimitedMotion {
  Planes3 &position, &change;  ///< [n x n] mates of a representative are left behind it
};

/// Passes over the springs that move both ends of those that are out of bounds, by inverse mass.
/// Springs in a fixed colouring, so any team gives the same bits; pins stay.
///
/// A stiff method leaves few springs to limit, about pins above all: after the first pass only the
/// blocks of a row beside those that the pass before changed are looked at. As printed, corrections
/// are also taken longer than they are from the second pass on, as in successive over-relaxation.
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
  int first_;  // sample of a row or column that colours begin with: the border's mates stand apart
  int block_;  // columns; a row has at most 64
  // A bit a block, counted by the samples that springs start from.
  std::vector<std::uint64_t> active_;   // [n] that are looked at
  std::vector<std::uint64_t> changed_;  // [n] that had springs to limit
};

}  // namespace weft
