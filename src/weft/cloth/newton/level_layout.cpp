#include "weft/cloth/newton/level_layout.h"

#include <algorithm>
#include <utility>

namespace weft {
namespace {

/// Where each of a row of intervals begins when all that ended before it began still do.
/// @param before  [k] first and last of the fine level  @param lengths  [k] of the coarse level
std::vector<int> pushed_together(const std::vector<Range>& before,
                                 const std::vector<int>& lengths) {
  std::vector<int> order(before.size()), first(before.size(), 0);
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return std::pair(before[a].first, a) < std::pair(before[b].first, b);
  });
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (before[order[j]].last <= before[order[i]].first)
        first[order[i]] =
            std::max(first[order[i]], first[order[j]] + lengths[order[j]] + LevelLayout::gap);
  return first;
}

}  // namespace

LevelLayout::LevelLayout(int side, std::vector<Chart> placed)
    : size(side), charts(std::move(placed)), rows(size, charts) {}

LevelLayout::LevelLayout(const BorderMates& mates) : LevelLayout(mates.size(), mates.charts()) {}

bool LevelLayout::has_gaps() const {
  const std::vector<int> chart = chart_of();
  for (std::size_t k = 0; k < charts.size(); ++k) {
    const Chart& one = charts[k];
    for (int r = std::max(0, one.row - gap); r < std::min(size, one.row + one.rows + gap); ++r)
      for (int c = std::max(0, one.col - gap); c < std::min(size, one.col + one.cols + gap); ++c) {
        const int there = chart[static_cast<std::size_t>(r) * size + c];
        if (there >= 0 && there != static_cast<int>(k)) return false;
      }
  }
  return true;
}

LevelLayout LevelLayout::coarsened() const {
  std::vector<Chart> coarse = charts;
  std::vector<Range> down, right;
  std::vector<int> heights, widths;
  for (Chart& chart : coarse) {
    down.push_back({chart.row, chart.row + chart.rows});
    right.push_back({chart.col, chart.col + chart.cols});
    heights.push_back(chart.rows = chart.rows / 2 + 1);
    widths.push_back(chart.cols = chart.cols / 2 + 1);
  }
  const std::vector<int> row = pushed_together(down, heights), col = pushed_together(right, widths);
  int side = 0;
  for (std::size_t k = 0; k < coarse.size(); ++k) {
    coarse[k].row = row[k];
    coarse[k].col = col[k];
    side = std::max({side, row[k] + heights[k], col[k] + widths[k]});
  }
  return {side, std::move(coarse)};
}

int LevelLayout::largest_side() const {
  int side = 0;
  for (const Chart& chart : charts) side = std::max({side, chart.rows, chart.cols});
  return side;
}

std::vector<int> LevelLayout::chart_of() const {
  std::vector<int> chart(static_cast<std::size_t>(size) * size, -1);
  for (int r = 0; r < size; ++r)
    for (const ChartRow& part : rows.row(r))
      std::fill(chart.begin() + static_cast<std::ptrdiff_t>(r) * size + part.columns.first,
                chart.begin() + static_cast<std::ptrdiff_t>(r) * size + part.columns.last,
                part.chart);
  return chart;
}

}  // namespace weft
