#include <gtest/gtest.h>

#include "tests/image/image_cases.h"
#include "weft/mesh_statistics.h"

namespace weft {
namespace {

GeometryImage torus(int n) { return test::torus_image(n); }

TEST(CoarserImage, TakesEverySecondSampleAndKeepsTheTopology) {
  const GeometryImage image = torus(33);
  for (int level = 1; level <= coarsest_level(image); ++level) {
    const std::optional<GeometryImage> coarse = coarser_image(image, level);
    ASSERT_TRUE(coarse) << level;
    const int step = 1 << level;
    EXPECT_EQ(coarse->size(), 32 / step + 1);
    EXPECT_TRUE(mates_bit_equal(*coarse));
    for (int r = 0; r < coarse->size(); ++r)
      for (int c = 0; c < coarse->size(); ++c)
        EXPECT_EQ(coarse->cube.at(r, c), image.cube.at(step * r, step * c));
    const TriangleMesh mesh = rebuild_mesh(*coarse).mesh;
    EXPECT_EQ(count_topology(static_cast<int>(mesh.positions.size()), mesh.triangles).euler, 0);
  }
  EXPECT_GE(coarsest_level(image), 2);
}

TEST(CoarserImage, LevelsThatAreNotThereAreNothing) {
  const GeometryImage image = torus(33);
  EXPECT_FALSE(coarser_image(image, coarsest_level(image) + 1));
  EXPECT_FALSE(coarser_image(image, -1));
  EXPECT_FALSE(coarser_image(torus(34), 1)) << "33 intervals have no half";
  GeometryImage shifted = image;
  shifted.mates = BorderMates(33, {{1, 95, 31}, {33, 127, 31}});
  EXPECT_FALSE(coarser_image(shifted, 1)) << "seams that begin between the samples of the level";
}

TEST(CoarserImage, LevelZeroIsTheImage) {
  const GeometryImage image = torus(17);
  test::expect_same_samples(*coarser_image(image, 0), image);
}

}  // namespace
}  // namespace weft
