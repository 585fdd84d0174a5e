#include <gtest/gtest.h>

#include "weft/drawing.h"
#include "weft/view/map_picture.h"

namespace weft::image_pictures_test {
namespace {

std::array<int, 3> pixel(const Picture& picture, int x, int y) {
  const std::size_t i = std::size_t{3} * (static_cast<std::size_t>(y) * picture.width + x);
  return {picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]};
}

TEST(ImagePictures, ColoursAreThePositionsEnlargedWholeTimes) {
  GeometryImage image;
  image.cube = Planes3(5);
  image.cube.set(0, 4, {1, 0.5F, 0});
  image.cube.set(3, 1, {0.2F, 1, 0.6F});
  const Picture picture = colours_of(image, 20);
  ASSERT_EQ(picture.width, 20);
  ASSERT_EQ(picture.height, 20);
  EXPECT_EQ(pixel(picture, 16, 0), (std::array<int, 3>{255, 128, 0}));
  EXPECT_EQ(pixel(picture, 19, 3), (std::array<int, 3>{255, 128, 0}));
  EXPECT_EQ(pixel(picture, 4, 12), (std::array<int, 3>{51, 255, 153}));
  EXPECT_EQ(pixel(picture, 8, 12), (std::array<int, 3>{0, 0, 0}));
}

/// Two halves of the square, the left one twice as long on the surface as it is wide in the square.
DiskMesh two_halves() {
  DiskMesh disk;
  disk.positions = {{0, 0, 0}, {2, 0, 0}, {2.5, 0, 0}, {0, 1, 0}, {2, 1, 0}, {2.5, 1, 0}};
  disk.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
  return disk;
}

TEST(ImagePictures, MapIsRedWhereShortOfRoomAndBlueWhereItHasMore) {
  const SquareMap map{5, {{0, 0}, {2, 0}, {4, 0}, {0, 4}, {2, 4}, {4, 4}}};
  MapDrawing options;
  options.side = 120;
  const Picture picture = draw_map(two_halves(), map, options);
  ASSERT_EQ(picture.width, 120);
  const auto left = pixel(picture, 40, 30);
  const auto right = pixel(picture, 100, 30);
  EXPECT_GT(left[0], left[2] + 20);
  EXPECT_GT(right[2], right[0] + 20);
}

TEST(ImagePictures, MapShowsItsEdges) {
  const SquareMap map{5, {{0, 0}, {2, 0}, {4, 0}, {0, 4}, {2, 4}, {4, 4}}};
  MapDrawing options;
  options.side = 120;
  options.stretch = false;
  const Picture picture = draw_map(two_halves(), map, options);
  // The edge from (2, 0) to (2, 4) is the picture's middle column; beside it is white.
  EXPECT_LT(pixel(picture, 60, 37)[0], 230);
  EXPECT_EQ(pixel(picture, 50, 37)[0], 255);
}

}  // namespace
}  // namespace weft::image_pictures_test
