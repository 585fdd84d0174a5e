#include <set>
#include <string_view>
#include <vector>

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

/// A line of text, black on white.
Picture line_of(std::string_view text, int scale) {
  Picture picture = blank_picture(text_width(text, scale), text_height(scale), {1, 1, 1});
  draw_text(picture, text, {0, 0, scale}, {0, 0, 0});
  return picture;
}

TEST(Text, FillsItsPlaceAndNoMore) {
  ASSERT_TRUE(has_font());
  for (const int scale : {1, 2, 5}) {
    const std::string_view text = "Agfy 0.5 %";
    Picture wide = blank_picture(text_width(text, scale) + 40, text_height(scale) + 40, {1, 1, 1});
    draw_text(wide, text, {20, 20, scale}, {0, 0, 0});
    EXPECT_EQ(dark_pixels(wide), dark_pixels(line_of(text, scale))) << scale;
    EXPECT_GT(dark_pixels(wide), 30 * scale * scale);
  }
}

TEST(Text, IsAsWideAsItsCharacters) {
  EXPECT_EQ(text_width("", 2), 0);
  EXPECT_GT(text_width("wwww", 2), 2 * text_width("iiii", 2));
  EXPECT_NEAR(text_width("stretch", 6), 3 * text_width("stretch", 2), 3);
}

TEST(Text, StemsAreEvenAndHaveSmoothEdges) {
  constexpr int scale = 20;
  const Picture stem = line_of("l", scale);
  std::vector<int> widths;
  for (int y = stem.height / 3; y < stem.height / 2; ++y) {
    int dark = 0, between = 0;
    for (int x = 0; x < stem.width; ++x) {
      const int value = pixel(stem, x, y)[0];
      dark += value < 128 ? 1 : 0;
      between += value > 0 && value < 255 ? 1 : 0;
    }
    widths.push_back(dark);
    EXPECT_LE(between, 2);
  }
  EXPECT_GT(widths.front(), scale / 2);
  EXPECT_EQ(std::set<int>(widths.begin(), widths.end()).size(), 1U);
}

TEST(Text, KnowsUtf8) {
  EXPECT_EQ(text_width("\u00e4", 4), text_width("a", 4)) << "as wide as its letter";
  EXPECT_GT(dark_pixels(line_of("\u00e4", 4)), dark_pixels(line_of("a", 4))) << "and two dots";
  EXPECT_GT(dark_pixels(line_of("\u03bb\u20ac", 4)), 50);
  // What is no UTF-8 is one replacement each.
  EXPECT_EQ(text_width("\xff", 4), text_width("\ufffd", 4));
  EXPECT_EQ(line_of("\xc3", 4).rgb, line_of("\ufffd", 4).rgb);
  EXPECT_EQ(line_of("\xc0\x80", 4).rgb, line_of("\ufffd\ufffd", 4).rgb);
}

TEST(Text, OutsideThePictureIsLeftOut) {
  Picture picture = blank_picture(4, 4, {1, 1, 1});
  draw_text(picture, "888", {-3, -4, 1}, {0, 0, 0});
  EXPECT_GT(dark_pixels(picture), 0);
  draw_text(picture, "8", {100, 100, 1}, {0, 0, 0});
}

TEST(Legend, BarRunsFromOneEndOfTheScaleToTheOther) {
  Picture picture = blank_picture(400, 100, {0, 1, 0});
  Legend plain = stretch_legend("stretch");
  plain.marks.clear();
  add_legend(picture, plain);
  ASSERT_EQ(picture.height, 100 + legend_height(400));
  EXPECT_EQ(pixel(picture, 200, 50), (Pixel{0, 255, 0})) << "the picture stays above";
  const int middle = 100 + 21;
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
