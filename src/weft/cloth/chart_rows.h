#pragma once

#include <span>
#include <vector>

#include "weft/core/thread_team.h"
#include "weft/geometry_image.h"

namespace weft {

/// The columns of a row that lie in a chart, the chart's rows, and which chart it is.
struct ChartRow {
  Range columns, rows;
  int chart = 0;
};

/// The parts of every row of an image that lie in charts, from left to right.
class ChartRows {
 public:
  ChartRows() = default;
  ChartRows(int size, std::span<const Chart> charts);
  explicit ChartRows(const BorderMates& mates) : ChartRows(mates.size(), mates.charts()) {}

  [[nodiscard]] std::span<const ChartRow> row(int r) const {
    return std::span(parts_).subspan(starts_[r], starts_[r + 1] - starts_[r]);
  }

 private:
  std::vector<int> starts_{0};  // [n + 1]
  std::vector<ChartRow> parts_;
};

}  // namespace weft
