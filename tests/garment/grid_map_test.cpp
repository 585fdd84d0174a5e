#include "weft/garment/grid_map.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace weft {
namespace {

/// The border of a unit square with so many intervals a side, whose first row goes as given.
std::vector<Vec2d> square(int rows, int cols, const std::function<double(double)>& first_row) {
  std::vector<Vec2d> border;
  border.reserve(2 * static_cast<std::size_t>(rows + cols));
  const auto part = [](int k, int of) { return static_cast<double>(k) / of; };
  for (int k = 0; k < cols; ++k) border.push_back({part(k, cols), first_row(part(k, cols))});
  for (int k = 0; k < rows; ++k) border.push_back({1, part(k, rows)});
  for (int k = 0; k < cols; ++k) border.push_back({1 - part(k, cols), 1});
  for (int k = 0; k < rows; ++k) border.push_back({0, 1 - part(k, rows)});
  return border;
}

double straight(double /*x*/) { return 0; }
double notched(double x) { return 0.8 * std::max(0.0, 1 - std::abs(x - 0.5) / 0.25); }

TEST(GridMap, UnfoldsAGridInANotchedOutline) {
  for (const int side : {24, 151, 200}) {
    const auto grid = spread_inside(square(side, side, notched), side + 1, side + 1);
    ASSERT_TRUE(grid.has_value()) << side;
    EXPECT_TRUE(grid->unfolded()) << side;
  }
}

void expect_even(int rows, int cols) {
  const auto grid = spread_inside(square(rows, cols, straight), rows + 1, cols + 1);
  ASSERT_TRUE(grid.has_value());
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= cols; ++c) {
      EXPECT_NEAR(grid->at(r, c).x, static_cast<double>(c) / cols, 1e-3);
      EXPECT_NEAR(grid->at(r, c).y, static_cast<double>(r) / rows, 1e-3);
    }
}

TEST(GridMap, KeepsARectangleEven) {
  expect_even(4, 8);
  expect_even(66, 101);  // sides that do not halve
}

TEST(GridMap, EstimatesTheSameCostOfFewAndManySamples) {
  const auto cost = [](int side, const std::function<double(double)>& first_row) {
    return spread_cost(square(side, side, first_row), side + 1, side + 1);
  };
  EXPECT_NEAR(cost(32, straight), 4, 1e-3);
  EXPECT_NEAR(cost(500, straight), 4, 1e-3);
  const auto bent = [](double x) { return 0.5 * std::sin(3.14159265 * x); };
  EXPECT_GT(cost(64, bent), 4.2);
  EXPECT_NEAR(cost(512, bent), cost(64, bent), 0.02 * cost(64, bent));
}

}  // namespace
}  // namespace weft
