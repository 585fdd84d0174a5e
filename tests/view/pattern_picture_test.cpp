#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "weft/drawing.h"
#include "weft/garment.h"
#include "weft/view/polygon.h"

namespace weft {
namespace {

/// Of all pixels, how much darker than white they are.
double ink_of(const Picture& picture) {
  double sum = 0;
  for (const std::uint8_t channel : picture.rgb) sum += 1 - channel / 255.0;
  return sum / 3;
}

bool has_pixel(const Picture& picture, Vec3f colour) {
  const auto channel = [](float value) { return static_cast<int>(std::lround(255 * value)); };
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
    if (picture.rgb[i] == channel(colour.x) && picture.rgb[i + 1] == channel(colour.y) &&
        picture.rgb[i + 2] == channel(colour.z))
      return true;
  return false;
}

PatternPanel square(const std::string& name, double side) {
  PatternPanel panel;
  panel.name = name;
  panel.vertices = {{0, 0}, {side, 0}, {side, side}, {0, side}};
  for (int k = 0; k < 4; ++k) panel.edges.push_back({k, (k + 1) % 4});
  return panel;
}

TEST(Polygon, CoversAsManyPixelsAsItsArea) {
  Picture picture = blank_picture(40, 30, {1, 1, 1});
  const std::vector<Vec2d> corners{{3.3, 2.1}, {35.7, 8.4}, {20.2, 27.9}};
  fill_polygon(picture, corners, {0, 0, 0});
  const double area = 0.5 * cross(corners[1] - corners[0], corners[2] - corners[0]);
  EXPECT_NEAR(ink_of(picture), area, 0.01 * area);
}

TEST(Polygon, OutsideThePictureIsLeftOut) {
  Picture picture = blank_picture(10, 10, {1, 1, 1});
  fill_polygon(picture, std::vector<Vec2d>{{-50, -50}, {5, -50}, {5, 60}, {-50, 60}}, {0, 0, 0});
  EXPECT_NEAR(ink_of(picture), 50, 0.5);
  fill_polygon(picture, std::vector<Vec2d>{{50, 50}, {60, 50}, {60, 60}}, {0, 0, 0});
  EXPECT_NEAR(ink_of(picture), 50, 0.5);
}

TEST(Polygon, LineIsAsWideAsAskedFor) {
  Picture picture = blank_picture(60, 20, {1, 1, 1});
  draw_line(picture, std::vector<Vec2d>{{10, 10}, {50, 10}}, 4, {0, 0, 0});
  EXPECT_NEAR(ink_of(picture), 4 * 40 + 3.14 * 4, 2);
}

TEST(PatternPicture, ColoursStitchesAndLeavesTheRestDark) {
  Pattern pattern;
  pattern.panels = {square("a", 0.3), square("b", 0.2)};
  pattern.stitches = {{{0, 1}, {1, 3}}};
  const Picture picture = draw_pattern(pattern, 1200, 1000);
  EXPECT_EQ(picture.width, 1200);
  EXPECT_EQ(picture.height, 1000);
  EXPECT_TRUE(has_pixel(picture, curve_colour(0)));
  EXPECT_FALSE(has_pixel(picture, curve_colour(1)));
  EXPECT_TRUE(has_pixel(picture, {0.25F, 0.26F, 0.28F}));
}

TEST(PatternPicture, HoldsAnyNumberOfPanels) {
  for (const int count : {1, 7, 60}) {
    Pattern pattern;
    for (int k = 0; k < count; ++k) pattern.panels.push_back(square(std::to_string(k), 0.1 + k));
    const Picture picture = draw_pattern(pattern, 300, 400);
    // Its frame stays white.
    for (int x = 0; x < picture.width; ++x) {
      EXPECT_EQ(picture.rgb[3 * static_cast<std::size_t>(x)], 255);
      EXPECT_EQ(picture.rgb[3 * (static_cast<std::size_t>(399) * 300 + x)], 255);
    }
    EXPECT_GT(ink_of(picture), 0.01 * 300 * 400);
  }
}

/// Names as wide as the picture, or panels without end, leave no panel out.
TEST(PatternPicture, PanelsComeBeforeTheirNames) {
  for (const int count : {1, 60, 700}) {
    Pattern pattern;
    for (int k = 0; k < count; ++k) pattern.panels.push_back(square(std::string(60, 'n'), 0.3));
    EXPECT_GT(ink_of(draw_pattern(pattern, 120, 90)), 0.02 * 120 * 90) << count;
  }
}

}  // namespace
}  // namespace weft
