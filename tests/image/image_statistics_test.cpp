#include <gtest/gtest.h>

#include "weft/image/builtin.h"
#include "weft/image_quality.h"

namespace weft {
namespace {

TEST(ImageStatistics, FlatSheetIsNotStretchedAndNotFolded) {
  const ImageStatistics statistics = examine_image(make_image_shape("sheet", 17));
  EXPECT_NEAR(statistics.stretch_l2, 1, 1e-6);
  EXPECT_NEAR(statistics.stretch_linf, 1, 1e-5);
  EXPECT_EQ(statistics.folded_quads, 0);
  EXPECT_EQ(statistics.zero_area_triangles, 0);
  EXPECT_EQ(statistics.largest_mate_class, 0);
  EXPECT_NEAR(statistics.box.extent().x, 1, 1e-6);
}

TEST(ImageStatistics, TorusHasItsFourCornersInOneClass) {
  EXPECT_EQ(examine_image(make_image_shape("torus", 17)).largest_mate_class, 4);
}

TEST(ImageStatistics, NamesTheQuadThatIsStretchedMostAndSeesFolds) {
  GeometryImage image = make_image_shape("sheet", 9);
  const Vec3f before = image.cube.at(4, 4);
  image.cube.set(4, 4, {before.x, 0.5F, before.z});
  const ImageStatistics pulled = examine_image(image);
  EXPECT_GT(pulled.stretch_linf, 2);
  EXPECT_TRUE(pulled.worst_quad[0] == 3 || pulled.worst_quad[0] == 4);
  EXPECT_TRUE(pulled.worst_quad[1] == 3 || pulled.worst_quad[1] == 4);
  // A sample pulled beyond its neighbour's neighbour turns triangles over.
  image.cube.set(4, 4, image.cube.at(4, 7));
  EXPECT_GT(examine_image(image).folded_quads, 0);
}

TEST(ImageStatistics, CountsTrianglesThatShrankToNothing) {
  GeometryImage image = make_image_shape("sheet", 9);
  image.cube.set(4, 4, image.cube.at(4, 5));
  EXPECT_EQ(examine_image(image).zero_area_triangles, 2);
}

}  // namespace
}  // namespace weft
