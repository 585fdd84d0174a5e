#pragma once

#include <vector>

#include "weft/cloth/newton/level_layout.h"
#include "weft/cloth/newton/padded_planes.h"

namespace weft {

/// The charts of a coarse level whose last interval is as short as one of the finer level, as that
/// has an even number of rows or columns. Transfers and Galerkin products take the last node to lie
/// one sample beyond the last, which then gets the mean of the last two nodes: where seams have
/// parts of several charts, one particle would get different values. Here the last node lies at the
/// last sample, and the one beyond is extrapolated: S^T of the nodes' values, S of what is
/// restricted, S A S^T of a Galerkin product. To be called by every worker, with barriers between.
class ShortEnds {
 public:
  ShortEnds() = default;
  ShortEnds(const LevelLayout& fine, const LevelLayout& coarse);
  [[nodiscard]] bool empty() const { return ends_.empty(); }
  /// Puts values beyond the last samples in place of the last nodes'.
  void extrapolate(const Workers& workers, PaddedVectors& values) const;
  /// What was restricted to nodes beyond goes to the last two nodes.
  void fold(const Workers& workers, PaddedVectors& restricted) const;
  /// The same for stencils of 3 x 3 blocks, own parts, as BlockLevel::stencil has them.
  void fold(const Workers& workers, PlaneSet& stencil) const;

 private:
  struct End {
    Chart chart;  // of the coarse level
    bool rows = false, cols = false;
  };
  std::vector<End> ends_;
};

}  // namespace weft
