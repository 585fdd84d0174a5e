#pragma once

#include <span>
#include <vector>

#include "weft/collide/broad_phase/node_levels.h"

namespace weft {

/// Lists of columns, one for each row.
class RowLists {
 public:
  void add(int col) { cols_.push_back(col); }
  void end_row() { starts_.push_back(static_cast<int>(cols_.size())); }
  [[nodiscard]] std::span<const int> row(int r) const {
    return std::span(cols_).subspan(starts_[r], starts_[r + 1] - starts_[r]);
  }

 private:
  std::vector<int> starts_{0}, cols_;
};

/// Which chart the nodes of a surface's mip pyramid have cells of. A window of nodes is a rectangle
/// of the surface only if all its cells are of one.
class ChartNodes {
 public:
  static constexpr int none = -1, several = -2;

  ChartNodes() = default;
  explicit ChartNodes(const SurfaceGrid& grid);

  /// Whether the image is one chart without gaps: then there is nothing to ask.
  [[nodiscard]] bool empty() const { return levels_.empty(); }
  /// A number from 0, none or several. @pre not empty()
  [[nodiscard]] int chart_of(const Node& node) const {
    return levels_[static_cast<std::size_t>(node.level)].charts(node.row, node.col);
  }
  /// Of a row of a level, the nodes that have no chart, and several.
  [[nodiscard]] std::span<const int> without(int level, int row) const {
    return levels_[static_cast<std::size_t>(level)].without.row(row);
  }
  [[nodiscard]] std::span<const int> mixed(int level, int row) const {
    return levels_[static_cast<std::size_t>(level)].mixed.row(row);
  }
  /// The columns at which windows of 2 x 2 or of 3 x 3 nodes begin that have several charts, of a
  /// row of windows.
  [[nodiscard]] std::span<const int> mixed_windows(int level, int row, int size) const {
    const Level& of = levels_[static_cast<std::size_t>(level)];
    return (size == 2 ? of.mixed_twos : of.mixed_threes).row(row);
  }

 private:
  struct Level {
    Grid<int> charts;
    RowLists without{}, mixed{}, mixed_twos{}, mixed_threes{};
  };
  static Grid<int> number_cells(const SurfaceGrid& grid);
  static void fill_lists(Level& level);

  std::vector<Level> levels_;
};

}  // namespace weft
