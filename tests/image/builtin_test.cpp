#include "weft/image/builtin.h"

#include <gtest/gtest.h>

#include "weft/error.h"
#include "weft/image_quality.h"
#include "weft/mesh/shapes/parametric.h"

namespace weft {
namespace {

TEST(BuiltinImage, SheetRunsAlongXWithColumnsAndAlongZWithRows) {
  const GeometryImage image = make_image_shape("sheet", 17);
  EXPECT_EQ(image.size(), 17);
  EXPECT_EQ(image.source, "builtin:sheet");
  EXPECT_EQ(image.mates.class_count(), 0);
  EXPECT_EQ(image.world_position(0, 0), (Vec3d{-0.5, 0, -0.5}));
  EXPECT_EQ(image.world_position(0, 16), (Vec3d{0.5, 0, -0.5}));
  EXPECT_EQ(image.world_position(16, 0), (Vec3d{-0.5, 0, 0.5}));
  EXPECT_EQ(image.world_position(4, 8), (Vec3d{0, 0, -0.25}));
}

TEST(BuiltinImage, DiskHasItsBorderOnTheCircle) {
  const int n = 33;
  const GeometryImage image = make_image_shape("disk", n);
  EXPECT_EQ(image.mates.class_count(), 0);
  for (int k = 0; k < n; ++k) {
    EXPECT_NEAR(length(image.world_position(0, k)), 0.5, 1e-7);
    EXPECT_NEAR(length(image.world_position(k, n - 1)), 0.5, 1e-7);
    EXPECT_LT(length(image.world_position(1, k == 0 || k == n - 1 ? 1 : k)), 0.49);
  }
  EXPECT_NEAR(length(image.world_position(16, 16)), 0, 1e-7);
}

TEST(BuiltinImage, EveryShapeFillsTheUnitCube) {
  for (const char* name : {"sheet", "disk", "torus", "cylinder"}) {
    const GeometryImage image = make_image_shape(name, 65);
    float least = 1, largest = 0;
    for (int r = 0; r < 65; ++r)
      for (int c = 0; c < 65; ++c)
        for (const float value : {image.cube.x(r, c), image.cube.y(r, c), image.cube.z(r, c)}) {
          least = std::min(least, value);
          largest = std::max(largest, value);
        }
    EXPECT_EQ(least, 0) << name;
    EXPECT_EQ(largest, 1) << name;
  }
}

TEST(BuiltinImage, TorusMatesHoldEqualBitsAndItsCornersAreOnePoint) {
  const int n = 17;
  const GeometryImage image = make_image_shape("torus", n);
  EXPECT_TRUE(mates_bit_equal(image));
  // One class of four corners, and a pair for every other sample of two sides.
  EXPECT_EQ(image.mates.class_count(), 1 + 2 * (n - 2));
  ASSERT_EQ(image.mates.mates(0).size(), 4U);
  for (int k = 0; k < n; ++k) {
    EXPECT_EQ(image.mates.representative(k * n + n - 1), image.mates.representative(k * n));
    EXPECT_EQ(image.mates.representative((n - 1) * n + k), image.mates.representative(k));
  }
}

TEST(BuiltinImage, TorusLiesOnItsSurfaceAndFacesOutwards) {
  const int n = 33;
  const GeometryImage image = make_image_shape("torus", n);
  for (int r = 0; r + 1 < n; ++r)
    for (int c = 0; c + 1 < n; ++c) {
      const Vec3d p = image.world_position(r, c);
      const Vec3d on_ring = torus_major_radius * normalized(Vec3d{p.x, 0, p.z});
      EXPECT_NEAR(length(p - on_ring), torus_minor_radius, 1e-6);
      const Vec3d normal =
          cross(image.world_position(r, c + 1) - p, image.world_position(r + 1, c) - p);
      EXPECT_GT(dot(normalized(normal), normalized(p - on_ring)), 0.9);
    }
}

TEST(BuiltinImage, CylinderClosesAroundAndIsOpenAtBothEnds) {
  const int n = 17;
  const GeometryImage image = make_image_shape("cylinder", n);
  EXPECT_TRUE(mates_bit_equal(image));
  EXPECT_EQ(image.mates.class_count(), n);
  for (int k = 0; k < n; ++k) {
    EXPECT_EQ(image.mates.representative(k * n + n - 1), image.mates.representative(k * n));
    EXPECT_NEAR(image.world_position(0, k).y, -0.5, 1e-7);
    EXPECT_NEAR(image.world_position(n - 1, k).y, 0.5, 1e-7);
  }
  const ImageQuality found = measure_topology(image);
  EXPECT_EQ(found.euler, 0);
  EXPECT_EQ(found.boundaries, 2);
}

TEST(BuiltinImage, OtherShapesAreAUsageError) {
  try {
    make_image_shape("sphere", 17);
    FAIL() << "no error";
  } catch (const UsageError& error) {
    EXPECT_STREQ(
        error.what(),
        "builtin:sphere: not a shape that is an image by nature; one of sheet, disk, torus, "
        "cylinder is wanted");
  }
}

}  // namespace
}  // namespace weft
