#include "weft/image/skyline.h"

#include <algorithm>
#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "weft/core/random.h"

namespace weft {
namespace {

using Place = std::array<int, 2>;

TEST(Skyline, TakesTheHighestPlaceAndThereTheLeftmost) {
  Skyline skyline(10);
  EXPECT_EQ(skyline.take(4, 3), (Place{0, 0}));
  EXPECT_EQ(skyline.take(4, 1), (Place{4, 0}));
  EXPECT_EQ(skyline.take(4, 2), (Place{4, 1}));  // the two columns beside are too narrow
  EXPECT_EQ(skyline.take(2, 9), (Place{8, 0}));
  EXPECT_EQ(skyline.take(10, 1), (Place{0, 9}));
}

/// The place that a search of all columns finds.
Place highest_place(const std::vector<int>& depths, int width) {
  Place best{0, 1 << 30};
  for (int col = 0; col + width <= static_cast<int>(depths.size()); ++col) {
    const int row = *std::max_element(depths.begin() + col, depths.begin() + col + width);
    if (row < best[1]) best = {col, row};
  }
  return best;
}

TEST(Skyline, IsThatOfASearchThroughAllColumns) {
  constexpr int width = 37;
  Random random(5);
  Skyline skyline(width);
  std::vector<int> depths(width, 0);
  for (int k = 0; k < 200; ++k) {
    const int cols = 1 + random.index(width), rows = 1 + random.index(9);
    const Place expected = highest_place(depths, cols);
    ASSERT_EQ(skyline.take(cols, rows), expected) << k;
    std::fill_n(depths.begin() + expected[0], cols, expected[1] + rows);
  }
}

}  // namespace
}  // namespace weft
