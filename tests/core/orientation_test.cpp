#include "weft/core/orientation.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

TEST(Orientation, TellsTurnsApart) {
  EXPECT_EQ(orientation({0, 0}, {1, 0}, {0, 1}), 1);
  EXPECT_EQ(orientation({0, 0}, {0, 1}, {1, 0}), -1);
  EXPECT_EQ(orientation({0, 0}, {1, 1}, {2, 2}), 0);
}

// Points of one line with slope 1, one of them moved by the least amount that a double can: plain
// arithmetic calls many of these collinear or gets the sign wrong.
TEST(Orientation, SeesTheLeastPossibleMove) {
  const Vec2d a{0.5, 0.5}, b{12, 12};
  for (int i = 1; i < 200; ++i) {
    const double x = 0.5 + i * 0x1p-53 * 64;
    EXPECT_EQ(orientation(a, b, {x, x}), 0);
    EXPECT_EQ(orientation(a, b, {x, x + 0x1p-52}), 1) << i;
    EXPECT_EQ(orientation(a, b, {x + 0x1p-52, x}), -1) << i;
  }
}

TEST(Orientation, IsAntisymmetricUnderAnySwap) {
  const Vec2d a{0.1, 0.3}, b{0.7, 0.9}, c{0.1 + 1e-16, 0.3 + 1e-16};
  const int sign = orientation(a, b, c);
  EXPECT_EQ(orientation(b, a, c), -sign);
  EXPECT_EQ(orientation(a, c, b), -sign);
  EXPECT_EQ(orientation(b, c, a), sign);
}

}  // namespace
}  // namespace weft
