#include "weft/core/orientation.h"

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>

#include "tests/support/random_points.h"

namespace weft {
namespace {

TEST(Orientation, TellsTurnsApart) {
  EXPECT_EQ(orientation({0, 0}, {1, 0}, {0, 1}), 1);
  EXPECT_EQ(orientation({0, 0}, {0, 1}, {1, 0}), -1);
  EXPECT_EQ(orientation({0, 0}, {1, 1}, {2, 2}), 0);
  EXPECT_EQ(orientation(Vec2d{}, Vec2d{}, Vec2d{}), 0);
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

using Rational = boost::multiprecision::cpp_rational;

Rational difference(double a, double b) { return Rational(a) - Rational(b); }

int exact(Vec3d a, Vec3d b, Vec3d c, Vec3d d) {
  const auto row = [&](Vec3d p) {
    return std::array{difference(p.x, d.x), difference(p.y, d.y), difference(p.z, d.z)};
  };
  const auto p = row(a), q = row(b), r = row(c);
  const Rational determinant = p[0] * (q[1] * r[2] - q[2] * r[1]) +
                               p[1] * (q[2] * r[0] - q[0] * r[2]) +
                               p[2] * (q[0] * r[1] - q[1] * r[0]);
  return -determinant.compare(0);
}

TEST(Orientation, TellsSidesOfAPlaneApart) {
  const Vec3d a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
  EXPECT_EQ(orientation(a, b, c, {0.2, 0.2, 1}), 1);
  EXPECT_EQ(orientation(a, b, c, {0.2, 0.2, -1}), -1);
  EXPECT_EQ(orientation(a, b, c, {7, -3, 0}), 0);
  EXPECT_EQ(orientation(b, a, c, {0.2, 0.2, 1}), -1);
}

// Points within rounding of one tilted plane, moved by less than a filter can see.
TEST(Orientation, InSpaceEqualsRationalArithmetic) {
  Random random(3);
  int zeros = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3d a = test::random_point(random), b = test::random_point(random),
                c = test::random_point(random);
    const double s = random.index(5) / 4.0, t = random.index(5) / 4.0;
    Vec3d d = a + s * (b - a) + t * (c - a);
    if (i % 3 == 0) d.x += (random.index(3) - 1) * 0x1p-53;
    const int sign = exact(a, b, c, d);
    zeros += sign == 0 ? 1 : 0;
    ASSERT_EQ(orientation(a, b, c, d), sign) << i;
  }
  EXPECT_GT(zeros, 100);
}

// Sizes apart by more than fixed room holds, and products that underflow.
TEST(Orientation, InSpaceIsExactWhateverTheSizes) {
  EXPECT_EQ(orientation({1e30, 0, 0}, {0, 1e30, 0}, {0, 0, 1e-30}, {0, 0, 0}), -1);
  EXPECT_EQ(orientation({1e30, 0, 1}, {0, 1e30, 1}, {0, 0, 1 + 0x1p-52}, {0, 0, 1}), -1);
  const Vec3d a{1e-150, 0, 0}, b{0, 1e-150, 0}, c{0, 0, 1e-150};
  EXPECT_EQ(orientation(a, b, c, {0, 0, 0}), -1);
  EXPECT_EQ(orientation(Vec2d{1e-200, 0}, Vec2d{0, 1e-200}, Vec2d{0, 0}), 1);
}

}  // namespace
}  // namespace weft
