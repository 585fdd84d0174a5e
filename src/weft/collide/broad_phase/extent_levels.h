#pragma once

#include <array>
#include <vector>

#include "weft/collide/broad_phase/node_levels.h"
#include "weft/core/thread_team.h"
#include "weft/grid.h"

namespace weft {

/// Least and largest of a vector over the cells below each node of a mip pyramid: the image is the
/// tree, so that fitting is two passes of minima and maxima and nothing is ever built.
class ExtentLevels {
 public:
  ExtentLevels() = default;
  explicit ExtentLevels(int cells);

  /// The cells' own, for the caller to fill: least x, y, z, largest x, y, z. [cells x cells]
  [[nodiscard]] std::array<Grid<float>, 6>& finest() { return finest_; }
  [[nodiscard]] const std::array<Grid<float>, 6>& finest() const { return finest_; }
  /// Fits all levels from it. To be called by every worker after a barrier; ends with one.
  void fit(Worker& worker);

  [[nodiscard]] const std::vector<int>& sides() const { return sides_; }
  [[nodiscard]] int top() const { return static_cast<int>(sides_.size()) - 1; }
  [[nodiscard]] const Box3f& at(const Node& node) const {
    const auto level = static_cast<std::size_t>(node.level);
    return boxes_[level][static_cast<std::size_t>(node.row) * sides_[level] + node.col];
  }

 private:
  void pack_row(int row);
  void fit_row(std::size_t level, int row);

  std::vector<int> sides_;
  std::array<Grid<float>, 6> finest_;
  std::vector<std::vector<Box3f>> boxes_;  // of each level [side * side]: one's six lie together
};

/// Fills the boxes of a surface's cells over a step. To be called by every worker; ends with a
/// barrier. Positions that are not finite make boxes that meet nothing.
void fill_position_extents(const Planes3& start, const Planes3& end, ExtentLevels& levels,
                           Worker& worker);

}  // namespace weft
