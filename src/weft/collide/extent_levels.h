#pragma once

#include <array>
#include <vector>

#include "weft/collide/node_levels.h"
#include "weft/core/grid.h"
#include "weft/core/planes.h"
#include "weft/core/thread_team.h"

namespace weft {

/// Least and largest of a vector over the cells below each node of a mip pyramid: the image is the
/// tree, so that fitting is two passes of minima and maxima and nothing is ever built.
class ExtentLevels {
 public:
  ExtentLevels() = default;
  explicit ExtentLevels(int cells);

  /// The cells' own, for the caller to fill: least x, y, z, largest x, y, z. [cells x cells]
  [[nodiscard]] std::array<Grid<float>, 6>& finest() { return levels_.front(); }
  /// Fits the coarser levels, all of them. To be called by every worker after a barrier; ends with
  /// one.
  void fit(Worker& worker);

  [[nodiscard]] const std::vector<int>& sides() const { return sides_; }
  [[nodiscard]] int top() const { return static_cast<int>(sides_.size()) - 1; }
  [[nodiscard]] Box3f at(const Node& node) const {
    const auto& l = levels_[static_cast<std::size_t>(node.level)];
    const std::ptrdiff_t i = node.row * l[0].stride() + node.col;
    return {{l[0].row(0)[i], l[1].row(0)[i], l[2].row(0)[i]},
            {l[3].row(0)[i], l[4].row(0)[i], l[5].row(0)[i]}};
  }

 private:
  std::vector<int> sides_;
  std::vector<std::array<Grid<float>, 6>> levels_;
};

/// Fills the boxes of a surface's cells over a step. To be called by every worker; ends with a
/// barrier. Positions that are not finite make boxes that meet nothing.
void fill_position_extents(const Planes3& start, const Planes3& end, ExtentLevels& levels,
                           Worker& worker);
/// Fills the extents of the edges along rows (samples (r, c) to (r, c + 1)) or columns of each
/// cell's two, at both ends of the step.
enum class EdgeWay { along_row, along_column };
void fill_edge_extents(EdgeWay way, const Planes3& start, const Planes3& end, ExtentLevels& levels,
                       Worker& worker);

}  // namespace weft
