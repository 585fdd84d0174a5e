#include <gtest/gtest.h>

#include "weft/drawing.h"
#include "weft/image/builtin.h"
#include "weft/picture.h"
#include "weft/view/text.h"

namespace weft {
namespace {

using Pixel = std::array<int, 3>;

Pixel pixel(const Picture& picture, int x, int y) {
  const std::size_t i = std::size_t{3} * (static_cast<std::size_t>(y) * picture.width + x);
  return {picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]};
}

Pixel pixel_of(Vec3f colour) {
  Picture one = blank_picture(1, 1, colour);
  return pixel(one, 0, 0);
}

int dark_pixels(const Picture& picture) {
  int count = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) count += picture.rgb[i] < 128 ? 1 : 0;
  return count;
}

TEST(Text, IsDrawnInWholePixelsAtItsOwnSize) {
  Picture picture = blank_picture(text_width("1", 1), text_height(1), {1, 1, 1});
  draw_text(picture, "1", {0, 0, 1}, {0, 0, 0});
  EXPECT_EQ(dark_pixels(picture), 10);
  EXPECT_EQ(text_width("10", 1), 11);
}

TEST(Text, EnlargedHasStrokesAsWideAsThePenWithSmoothEdges) {
  constexpr int scale = 20;
  Picture picture = blank_picture(text_width("l", scale), text_height(scale), {1, 1, 1});
  draw_text(picture, "l", {0, 0, scale}, {0, 0, 0});
  int dark = 0, between = 0;  // across the stem, in the third column of five
  for (int x = 0; x < picture.width; ++x) {
    const int value = pixel(picture, x, 3 * scale)[0];
    dark += value < 128 ? 1 : 0;
    between += value > 0 && value < 255 ? 1 : 0;
    if (value < 255) {
      EXPECT_NEAR(x, 2.5 * scale, 0.5 * scale);
    }
  }
  EXPECT_NEAR(dark, 0.84 * scale, 1);
  EXPECT_LE(between, 2);
  const Picture thin = [] {
    Picture slash = blank_picture(text_width("/", 2), text_height(2), {1, 1, 1});
    draw_text(slash, "/", {0, 0, 2}, {0, 0, 0});
    return slash;
  }();
  int grey = 0;
  for (std::size_t i = 0; i < thin.rgb.size(); i += 3)
    grey += thin.rgb[i] > 20 && thin.rgb[i] < 235 ? 1 : 0;
  EXPECT_GT(grey, 5);
}

TEST(Text, OutsideThePictureIsLeftOut) {
  Picture picture = blank_picture(4, 4, {1, 1, 1});
  draw_text(picture, "888", {-3, -2, 1}, {0, 0, 0});
  EXPECT_GT(dark_pixels(picture), 0);
  draw_text(picture, "8", {100, 100, 1}, {0, 0, 0});
}

TEST(Text, EveryLetterOfTheLegendsIsThere) {
  for (const char letter :
       std::string("0123456789.,-+%:=/()_abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ")) {
    Picture picture = blank_picture(5, 9, {1, 1, 1});
    draw_text(picture, std::string(1, letter), {0, 0, 1}, {0, 0, 0});
    EXPECT_GT(dark_pixels(picture), 2) << letter;
  }
}

TEST(Legend, BarRunsFromOneEndOfTheScaleToTheOther) {
  Picture picture = blank_picture(400, 100, {0, 1, 0});
  Legend plain = stretch_legend("stretch");
  plain.marks.clear();
  add_legend(picture, plain);
  ASSERT_EQ(picture.height, 100 + legend_height(400));
  EXPECT_EQ(pixel(picture, 200, 50), (Pixel{0, 255, 0})) << "the picture stays above";
  const int middle = 100 + 19;
  EXPECT_EQ(pixel(picture, 25, middle), pixel_of(stretch_colour(0.25)));
  EXPECT_EQ(pixel(picture, 200, middle), pixel_of(stretch_colour(1)));
  EXPECT_EQ(pixel(picture, 375, middle), pixel_of(stretch_colour(4)));
}

TEST(Palette, StretchIsBlueBelowOneAndRedAbove) {
  EXPECT_GT(stretch_colour(0.3).z, stretch_colour(0.3).x + 0.3F);
  EXPECT_GT(stretch_colour(3).x, stretch_colour(3).z + 0.3F);
  EXPECT_NEAR(stretch_colour(1).x, stretch_colour(1).z, 0.05F);
  EXPECT_EQ(stretch_colour(0), stretch_colour(0.25));
}

TEST(Palette, NeighbouringCurvesAreToldApart) {
  for (int i = 0; i < 40; ++i)
    for (int j = i + 1; j < std::min(i + 4, 40); ++j)
      EXPECT_GT(length(curve_colour(i) - curve_colour(j)), 0.2F) << i << " and " << j;
}

TEST(BorderPictures, MatesOfATorusHaveOneColourOnBothSides) {
  const GeometryImage torus = make_image_shape("torus", 17);
  const std::vector<BorderBand> bands = border_bands(torus.mates);
  const Picture square = blank_picture(240, 240, {0, 0, 0});
  const Picture framed = framed_by_mates(square, bands, 17);
  ASSERT_EQ(framed.width, 240 + 2 * 10);
  // Opposite sides of the square are the same circle.
  const int middle = framed.width / 2 + 5, last = framed.width - 1;
  EXPECT_EQ(pixel(framed, middle, 1), pixel(framed, middle, last - 1));
  EXPECT_EQ(pixel(framed, 1, middle), pixel(framed, last - 1, middle));
  EXPECT_NE(pixel(framed, middle, 1), pixel(framed, 1, middle));
  EXPECT_EQ(pixel(framed, middle, middle), (Pixel{0, 0, 0}));
}

TEST(BorderPictures, CurvesInSpaceHaveTheColoursOfTheirBands) {
  const GeometryImage torus = make_image_shape("torus", 17);
  const std::vector<BorderBand> bands = border_bands(torus.mates);
  SurfaceDrawing drawing;
  add_cut(drawing, torus);
  ASSERT_EQ(2 * drawing.curves.size(), bands.size());
  for (std::size_t i = 0; i < drawing.curves.size(); ++i) {
    EXPECT_EQ(drawing.curves[i].colour, bands[2 * i].colour);
    EXPECT_EQ(bands[2 * i].colour, bands[2 * i + 1].colour);
    EXPECT_EQ(static_cast<int>(drawing.curves[i].points.size()), bands[2 * i].count + 1);
  }
}

}  // namespace
}  // namespace weft
