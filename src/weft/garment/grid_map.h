#pragma once

#include <optional>
#include <vector>

#include "weft/progress.h"
#include "weft/vec.h"

namespace weft {

/// A grid of points in the plane, row by row.
struct PlaneGrid {
  int rows = 0, cols = 0;
  std::vector<Vec2d> points;  ///< [rows * cols]
  [[nodiscard]] Vec2d& at(int row, int col) { return points[index(row, col)]; }
  [[nodiscard]] Vec2d at(int row, int col) const { return points[index(row, col)]; }
  /// Whether some way of cutting each cell in two leaves no triangle folded.
  [[nodiscard]] bool unfolded() const;

 private:
  [[nodiscard]] std::size_t index(int row, int col) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(cols) +
           static_cast<std::size_t>(col);
  }
};

/// Spreads a grid inside an outline of which each border sample is given, so that no cell is folded
/// and all are as near as may be to equal rectangles: the least sum over cells of
///   (|a|^2 + |b|^2 + area^2 + 1) / area
/// for the pairs of sides a, b of each cell, in units of the wanted cell. Folded cells are unfolded
/// by a bound on the area that tends to it from above, after [garanzha21]. Large grids begin from
/// coarser ones.
/// @param border  [2 (rows - 1) + 2 (cols - 1)] counter-clockwise from the first row and column
///                along the first row
/// @param rows, cols  samples a side, at least 3 each
/// @param progress  told nothing but that work goes on; may be null
/// @return nothing where cells stay folded
std::optional<PlaneGrid> spread_inside(const std::vector<Vec2d>& border, int rows, int cols,
                                       Progress* progress = nullptr);

/// How far a grid in that outline would be from squares of equal size, estimated on fewer
/// cells: the mean of the sum's terms, 4 at least; infinite where it stays folded.
double spread_cost(const std::vector<Vec2d>& border, int rows, int cols,
                   Progress* progress = nullptr);

}  // namespace weft
