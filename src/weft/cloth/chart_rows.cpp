#include "weft/cloth/chart_rows.h"

#include <algorithm>

namespace weft {

ChartRows::ChartRows(int size, std::span<const Chart> charts) {
  std::vector<std::vector<ChartRow>> parts(static_cast<std::size_t>(size));
  for (std::size_t k = 0; k < charts.size(); ++k) {
    const Chart& chart = charts[k];
    const Range columns{chart.col, chart.col + chart.cols}, rows{chart.row, chart.row + chart.rows};
    for (int r = rows.first; r < rows.last; ++r)
      parts[r].push_back({columns, rows, static_cast<int>(k)});
  }
  for (std::vector<ChartRow>& row : parts) {
    std::sort(row.begin(), row.end(), [](const ChartRow& a, const ChartRow& b) {
      return a.columns.first < b.columns.first;
    });
    parts_.insert(parts_.end(), row.begin(), row.end());
    starts_.push_back(static_cast<int>(parts_.size()));
  }
}

}  // namespace weft
