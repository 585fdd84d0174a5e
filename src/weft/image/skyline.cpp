#include "weft/image/skyline.h"

#include <algorithm>
#include <climits>
#include <deque>

#include "weft/core/assert.h"

namespace weft {

std::array<int, 2> Skyline::take(int width, int height) {
  WEFT_ASSERT(width <= static_cast<int>(depth_.size()));
  int best_col = 0, best_row = INT_MAX;
  // The columns of the window whose depth no later one reaches, deepest first.
  std::deque<int> deepest;
  for (int c = 0; c < static_cast<int>(depth_.size()); ++c) {
    while (!deepest.empty() && depth_[deepest.back()] <= depth_[c]) deepest.pop_back();
    deepest.push_back(c);
    if (deepest.front() <= c - width) deepest.pop_front();
    if (c + 1 < width || depth_[deepest.front()] >= best_row) continue;
    best_row = depth_[deepest.front()];
    best_col = c + 1 - width;
  }
  for (int c = best_col; c < best_col + width; ++c) depth_[c] = best_row + height;
  return {best_col, best_row};
}

}  // namespace weft
