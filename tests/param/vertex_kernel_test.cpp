#include <vector>

#include <gtest/gtest.h>

#include "weft/core/random.h"
#include "weft/param/vertex_star.h"

namespace weft {
namespace {

TEST(VertexKernel, OfASquareIsAllOfItSoThatItsMiddleIsChosen) {
  const std::vector<Vec2d> ring = {{3, 3}, {7, 3}, {7, 7}, {3, 7}};
  const auto point = kernel_point(ring);
  ASSERT_TRUE(point);
  EXPECT_NEAR(point->x, 5, 1e-12);
  EXPECT_NEAR(point->y, 5, 1e-12);
}

TEST(VertexKernel, OfAnLShapeIsItsInnerSquare) {
  const std::vector<Vec2d> ring = {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}};
  const auto point = kernel_point(ring);
  ASSERT_TRUE(point);
  EXPECT_NEAR(point->x, 0.5, 1e-12);
  EXPECT_NEAR(point->y, 0.5, 1e-12);
  EXPECT_TRUE(sees_all(ring, {0.9, 0.9}));
  EXPECT_FALSE(sees_all(ring, {1, 0.5}));
  EXPECT_FALSE(sees_all(ring, {2, 0.5}));
}

TEST(VertexKernel, OfAUShapeIsEmpty) {
  const std::vector<Vec2d> ring = {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  EXPECT_FALSE(kernel_point(ring));
}

TEST(VertexKernel, ThinnerThanDoublesIsNone) {
  // Nothing lies between two neighbouring numbers.
  const double up = 100 + 0x1p-46;
  const std::vector<Vec2d> ring = {{0, 100}, {1, 100}, {1, up}, {0, up}};
  EXPECT_FALSE(kernel_point(ring));
}

TEST(VertexKernel, OfRandomStarsSeesAllEdgesFromThePointItFinds) {
  Random random(3);
  int found = 0;
  for (int trial = 0; trial < 200; ++trial) {
    // Star-shaped around its first corner, as the neighbours of a collapsed vertex are.
    const std::vector<Vec2d> fan = {{0, 0}, {1, -0.3}, {1, 0.4}, {0.6, 1}, {-0.1, 0.5}};
    std::vector<Vec2d> ring;
    for (const Vec2d p : fan)
      ring.push_back({p.x + 100, p.y * (0.9 + 0.1 * random.uniform(0, 1)) - 50});
    const auto point = kernel_point(ring);
    if (!point) continue;
    ++found;
    EXPECT_TRUE(sees_all(ring, *point));
  }
  EXPECT_EQ(found, 200);
}

}  // namespace
}  // namespace weft
