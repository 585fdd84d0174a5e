#pragma once

#include <vector>

#include "weft/collide/broad_phase/chart_nodes.h"
#include "weft/collide/broad_phase/extents.h"
#include "weft/collide/broad_phase/patch_versions.h"
#include "weft/collide/kernels/collide_kernels.h"
#include "weft/collide/seam_strips.h"
#include "weft/core/thread_team.h"

namespace weft {

/// Finds windows of patches across seams that certainly do not meet themselves during a step, as
/// UnfoldedSeams does of cells: a search then need not compare the patches of both sides.
///
/// A window is three patches long on the first side of a straight seam and up to two patches deep
/// on either. It says something of those patches that lie in it whole.
class UnfoldedBlocks {
 public:
  UnfoldedBlocks() = default;
  /// @param charts  of the grid's nodes
  UnfoldedBlocks(const SurfaceGrid& grid, const ChartNodes& charts);

  /// Tests all windows. @param patches  extents  @param slack  of edges [m]
  void find_unfolded(const CollideKernels& kernels, const Extents& patches, float slack,
                     Worker& worker);
  /// Whether some window that holds two patches, row * side + column, is certainly unfolded.
  [[nodiscard]] bool unfolded(int a, int b) const {
    if (windows_.empty()) return false;
    for (const int window : windows_of_.row(a))
      if (marks_(0, window) != 0)
        for (const int other : windows_of_.row(b))
          if (other == window) return true;
    return false;
  }
  /// Calls visit(patch) for patches of windows that were unfolded when this was called last and are
  /// not now.
  template <class Visit>
  void for_refolded(const Visit& visit) {
    for (std::size_t i = 0; i < windows_.size(); ++i) {
      const bool is_unfolded = marks_(0, static_cast<int>(i)) != 0;
      if (known_[i] != 0 && !is_unfolded)
        for (const int patch : members_.row(static_cast<int>(i))) visit(patch);
      known_[i] = is_unfolded ? 1 : 0;
    }
  }

 private:
  /// A patch of a side, as the strip's parameters run.
  struct Part {
    int patch = 0;
    SeamStrips::Frame frame;
  };
  struct Window {
    std::vector<Part> parts;
  };
  class Layout;
  void join(const Window& window, const Extents& patches, int column);

  std::vector<Window> windows_;
  RowLists members_;     // patches that lie whole in each window
  RowLists windows_of_;  // of each patch
  Extents joined_;       // [1 x windows]
  Grid<float> marks_;    // [1 x windows]
  std::vector<char> known_;
};

}  // namespace weft
