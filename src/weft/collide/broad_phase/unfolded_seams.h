#pragma once

#include <vector>

#include "weft/collide/broad_phase/candidate_pairs.h"
#include "weft/collide/broad_phase/extents.h"
#include "weft/collide/kernels/collide_kernels.h"
#include "weft/collide/seam_strips.h"
#include "weft/core/thread_team.h"

namespace weft {

/// Finds windows across seams that certainly do not meet themselves during a step.
///
/// The two sides of a seam lie in different charts, or far from each other in one, so no window of
/// the image holds cells of both, and neighbours of the surface would be pairs that may meet. As a
/// grid of its own, a strip along a straight seam has parameters that run across it, where the
/// surface is continuous: the test of UnfoldedWindows holds for it, too.
class UnfoldedSeams {
 public:
  /// Prepares for strips, which are kept by reference. @param side  cells a side of the image
  void take(const SeamStrips& seams, int side, int workers);
  /// Tests all windows. @param cells  extents of all cells  @param slack  of edges [m]
  void find_unfolded(const CollideKernels& kernels, const Extents& cells, float slack,
                     Worker& worker);
  /// Whether some window that holds two cells is certainly unfolded.
  [[nodiscard]] bool unfolded(const CandidatePair& pair) const {
    if (marks_.empty()) return false;
    for (const SeamStrips::Place& a : seams_->places(pair.a))
      for (const SeamStrips::Place& b : seams_->places(pair.b))
        if (a.strip == b.strip && unfolded(a, b)) return true;
    return false;
  }

 private:
  /// Scratch rows of a worker: extents of a strip's cells, of 2 x 2 and of 3 x 3 of them.
  struct Lines {
    explicit Lines(int side);
    Extents cells, twos, threes;  // [4 x side], [3 x side], [1 x side]
  };
  [[nodiscard]] bool unfolded(const SeamStrips::Place& a, const SeamStrips::Place& b) const;
  void fill(const SeamStrips::Strip& strip, const Extents& cells, Lines& lines) const;
  void find_unfolded(const CollideKernels& kernels, const SeamStrips::Strip& strip, float slack,
                     Lines& lines);
  /// Marks of a strip's windows, by their first column: of 2 x 2 cells beside the seam, of 3 x 3
  /// from the first row, of 3 x 3 from the second.
  [[nodiscard]] float* marks(const SeamStrips::Strip& strip, int kind) {
    return marks_.data() + static_cast<std::size_t>(kinds) * strip.first + kind * strip.count;
  }
  [[nodiscard]] const float* marks(const SeamStrips::Strip& strip, int kind) const {
    return marks_.data() + static_cast<std::size_t>(kinds) * strip.first + kind * strip.count;
  }

  static constexpr int kinds = 3;
  const SeamStrips* seams_ = nullptr;
  std::vector<Lines> lines_;  // one a worker
  std::vector<float> marks_;
};

}  // namespace weft
