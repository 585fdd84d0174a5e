#pragma once

#include <vector>

#include "weft/cloth/chart_rows.h"
#include "weft/geometry_image.h"

namespace weft {

/// Where the charts of a level of the multigrid preconditioner lie. Chart k of the next coarser
/// level has its node (r, c) at (2 r, 2 c) of chart k of this one; where a chart has an even number
/// of rows or columns, its last coarse node lies one beyond.
struct LevelLayout {
  int size = 0;  ///< of the square that holds all charts
  std::vector<Chart> charts;
  ChartRows rows;

  LevelLayout() = default;
  explicit LevelLayout(const BorderMates& mates);
  /// Samples around a chart that have to be free of others, so that stencils which reach out of it
  /// find zeros.
  static constexpr int gap = 2;
  /// Whether charts have such gaps between them.
  [[nodiscard]] bool has_gaps() const;
  [[nodiscard]] LevelLayout coarsened() const;
  /// Rows or columns of the largest chart.
  [[nodiscard]] int largest_side() const;
  /// [size x size] the chart of every sample, or -1.
  [[nodiscard]] std::vector<int> chart_of() const;

 private:
  LevelLayout(int side, std::vector<Chart> placed);
};

}  // namespace weft
