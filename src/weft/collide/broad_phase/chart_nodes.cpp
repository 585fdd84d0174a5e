#include "weft/collide/broad_phase/chart_nodes.h"

#include <algorithm>

namespace weft {
namespace {

/// The chart of two parts together.
int joined(int a, int b) {
  if (a == ChartNodes::none || a == b) return b;
  return b == ChartNodes::none ? a : ChartNodes::several;
}

/// Of a square of nodes, as far as the level reaches.
int chart_of_square(const Grid<int>& charts, int row, int col, int size) {
  int chart = ChartNodes::none;
  for (int r = row; r < std::min(row + size, charts.rows()); ++r)
    for (int c = col; c < std::min(col + size, charts.cols()); ++c)
      chart = joined(chart, charts(r, c));
  return chart;
}

/// The cells of a chart: of another shape than a rectangle windows would tell nothing.
struct Rectangle {
  int first_row, first_col, last_row, last_col, count = 0;
  void take(int row, int col) {
    last_row = std::max(last_row, row);
    last_col = std::max(last_col, col);
    ++count;
  }
  [[nodiscard]] bool is_full() const {
    return count == (last_row - first_row + 1) * (last_col - first_col + 1);
  }
};

void list_windows(const Grid<int>& charts, int size, RowLists& out) {
  for (int r = 0; r + size <= charts.rows(); ++r) {
    for (int c = 0; c + size <= charts.cols(); ++c)
      if (chart_of_square(charts, r, c, size) == ChartNodes::several) out.add(c);
    out.end_row();
  }
}

}  // namespace

/// Charts are rectangles with gaps between them: a cell without one above and to its left begins a
/// chart, others go on with it.
Grid<int> ChartNodes::number_cells(const SurfaceGrid& grid) {
  const int n = grid.cells();
  Grid<int> charts(n, n, none);
  std::vector<Rectangle> found;
  const auto at = [&](int r, int c) { return r < 0 || c < 0 ? none : charts(r, c); };
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      if (grid.missing(r * n + c)) continue;
      int& chart = charts(r, c) = joined(at(r - 1, c), at(r, c - 1));
      if (chart == none) {
        chart = static_cast<int>(found.size());
        found.push_back({r, c, r, c});
      }
      if (chart >= 0) found[chart].take(r, c);
    }
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c)
      if (charts(r, c) >= 0 && !found[charts(r, c)].is_full()) charts(r, c) = several;
  return charts;
}

void ChartNodes::fill_lists(Level& level) {
  const Grid<int>& charts = level.charts;
  for (int r = 0; r < charts.rows(); ++r) {
    for (int c = 0; c < charts.cols(); ++c) {
      if (charts(r, c) == none) level.without.add(c);
      if (charts(r, c) == several) level.mixed.add(c);
    }
    level.without.end_row();
    level.mixed.end_row();
  }
  list_windows(charts, 2, level.mixed_twos);
  list_windows(charts, 3, level.mixed_threes);
}

ChartNodes::ChartNodes(const SurfaceGrid& grid) {
  if (!grid.has_missing()) return;
  levels_.push_back({number_cells(grid)});
  for (const int side : level_sides(grid.cells())) {
    if (side == levels_.back().charts.rows()) continue;
    Level level{Grid<int>(side, side)};
    for (int r = 0; r < side; ++r)
      for (int c = 0; c < side; ++c)
        level.charts(r, c) = chart_of_square(levels_.back().charts, 2 * r, 2 * c, 2);
    levels_.push_back(std::move(level));
  }
  for (Level& level : levels_) fill_lists(level);
}

}  // namespace weft
