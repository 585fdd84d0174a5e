#pragma once

#include <array>
#include <vector>

#include "weft/collide/broad_phase/node_levels.h"
#include "weft/collide/kernels/collide_kernels.h"
#include "weft/collide/moving_surface.h"
#include "weft/core/thread_team.h"
#include "weft/grid.h"

namespace weft {

/// The path boxes of all nodes of a surface's mip pyramid.
class PathBoxLevels {
 public:
  PathBoxLevels() = default;
  explicit PathBoxLevels(int cells);
  /// To be called by every worker; ends with a barrier.
  void fit(const MovingSurface& surface, Worker& worker);

  [[nodiscard]] const std::vector<int>& sides() const { return sides_; }
  [[nodiscard]] int top() const { return static_cast<int>(sides_.size()) - 1; }
  [[nodiscard]] const PathBox& root_box() const { return root_; }
  [[nodiscard]] PathBox box_of(const Node& node) const;
  /// Boxes of the cells of a tile, by the row and column of its first one.
  [[nodiscard]] TileBoxes tile(int row, int col) const;
  /// Boxes of the cells of a patch, by the row and column of its first one.
  [[nodiscard]] PatchBoxes patch(int row, int col) const;
  /// Boxes of the children of a node above the cells.
  [[nodiscard]] const ChildPathBoxes& children(const Node& node) const {
    const auto level = static_cast<std::size_t>(node.level);
    return children_[level][static_cast<std::size_t>(node.row) * sides_[level] + node.col];
  }

 private:
  void fill_row(const MovingSurface& surface, int row);
  /// Boxes of cells that lie in no chart meet nothing.
  void hide_missing(const SurfaceGrid& grid, int row);
  void fit_node(const Node& node);
  /// Faster form of fit_node for a node of level 1 that has all four cells.
  void pack_cells(const Node& node);
  void fit_row(int level, int row);

  std::vector<int> sides_;
  std::array<Grid<float>, 12> cells_;                  // the planes of PathBox in its order
  std::vector<std::vector<ChildPathBoxes>> children_;  // of each level [side * side], of 0 none
  PathBox root_;
};

}  // namespace weft
