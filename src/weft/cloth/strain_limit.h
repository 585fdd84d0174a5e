#pragma once

#include <cstdint>
#include <vector>

#include "weft/cloth/cloth.h"
#include "weft/cloth/kernels/kernel_table.h"
#include "weft/core/thread_team.h"

namespace weft {

struct LimitOptions {
  int passes = 10;
};

/// How long springs may be, in rest lengths.
struct StrainBounds {
  float shortest = 1, longest = 1;
  float inverse_step = 0;  ///< velocities change by the corrections times this [1/s]
};

/// Provot's limit [provot95]: stretch and shear springs longer than r (1 + e) or shorter than r (1
/// - e), e the material's strain limit, move both ends towards each other (or apart) along the
/// spring, by inverse mass, so that exactly the limit stands; velocities change by the same over h.
/// Springs in a fixed colouring, so any team gives the same bits; pins stay; mates stay equal.
///
/// A stiff method leaves few springs to limit, about pins above all: after the first pass only the
/// blocks of a row beside those that the pass before changed are looked at, and corrections are
/// taken longer than they are, as in successive over-relaxation, since what is too long there hangs
/// on all that is below.
class StrainLimit {
 public:
  /// @param cloth  kept by reference
  StrainLimit(const Cloth& cloth, const ThreadTeam& team);

  void limit(const LimitOptions& options, double time_step, ClothState& state,
             ThreadTeam& team) noexcept;
  /// Passes over the springs with bounds of one's own, to be called by every worker. Ends with a
  /// barrier; mates are left behind their representatives.
  void passes(int count, const StrainBounds& bounds, ClothState& state, Worker& worker) noexcept;

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

/// Limits once, with a StrainLimit of its own.
void limit_strain(const Cloth& cloth, const LimitOptions& options, double time_step,
                  ClothState& state, ThreadTeam& team);

}  // namespace weft
