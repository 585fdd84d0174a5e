#include <gtest/gtest.h>

#include "weft/picture.h"

namespace weft {
namespace {

constexpr Vec3f red{1, 0, 0}, blue{0, 0, 1};

bool is_red(const Picture& picture, int x, int y) {
  const std::size_t i = std::size_t{3} * (static_cast<std::size_t>(y) * picture.width + x);
  return picture.rgb[i] == 255 && picture.rgb[i + 1] == 0;
}

TEST(Panels, StandInARowWithTheirMiddlesInLine) {
  const Picture row =
      in_a_row({{blank_picture(10, 40, blue), ""}, {blank_picture(30, 20, red), ""}});
  EXPECT_EQ(row.width, 10 + panel_gap + 30);
  EXPECT_EQ(row.height, 40);
  const int left = 10 + panel_gap;
  EXPECT_TRUE(is_red(row, left, 10));
  EXPECT_TRUE(is_red(row, left + 29, 29));
  EXPECT_FALSE(is_red(row, left, 9));
  EXPECT_FALSE(is_red(row, left, 30));
}

TEST(Panels, AreLabelledBelowInAStripOfTheSaidHeight) {
  const Picture row =
      in_a_row({{blank_picture(60, 20, red), "l"}, {blank_picture(60, 20, red), ""}}, 1);
  EXPECT_EQ(row.height, 20 + label_height(1));
  int dark_left = 0, dark_right = 0;
  for (int y = 20; y < row.height; ++y)
    for (int x = 0; x < row.width; ++x) {
      const std::size_t i = std::size_t{3} * (static_cast<std::size_t>(y) * row.width + x);
      (x < 60 ? dark_left : dark_right) += row.rgb[i] < 128 ? 1 : 0;
    }
  EXPECT_GT(dark_left, 5);
  EXPECT_EQ(dark_right, 0);
}

TEST(Panels, StandInAColumnAcrossItsMiddle) {
  const Picture column = in_a_column({blank_picture(40, 10, blue), blank_picture(20, 10, red)});
  EXPECT_EQ(column.width, 40);
  EXPECT_EQ(column.height, 20 + panel_gap);
  EXPECT_TRUE(is_red(column, 10, 10 + panel_gap));
  EXPECT_FALSE(is_red(column, 9, 10 + panel_gap));
}

}  // namespace
}  // namespace weft
