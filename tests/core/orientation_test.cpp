#include "weft/core/orientation.h"

#include <array>
#include <cmath>

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

int exact(Vec2d a, Vec2d b, Vec2d c) {
  const Rational determinant =
      difference(a.x, c.x) * difference(b.y, c.y) - difference(a.y, c.y) * difference(b.x, c.x);
  return determinant.compare(0);
}

// Points on a line or near it, in single precision or with all digits, of one size or of many.
TEST(Orientation, InThePlaneEqualsRationalArithmetic) {
  Random random(5);
  std::array<int, 3> seen{};
  for (int i = 0; i < 30000; ++i) {
    const auto number = [&]() -> double {
      const double drawn = 2 * random.uniform() - 1, size = std::ldexp(1, random.index(60) - 30);
      if (i % 4 == 0) return random.index(5);
      if (i % 4 == 1) return static_cast<float>(drawn);
      return i % 4 == 2 ? drawn : drawn * size;
    };
    const Vec2d a{number(), number()}, way{number(), number()};
    const double s = random.index(9) / 4.0 - 1, t = random.index(9) / 4.0 - 1;
    Vec2d b = a + s * way, c = a + t * way;
    if (i % 8 < 4) b = {static_cast<float>(b.x), static_cast<float>(b.y)};
    if (i % 3 == 0) c.y += (random.index(3) - 1) * 0x1p-53;
    const int sign = exact(a, b, c);
    ++seen[static_cast<std::size_t>(sign + 1)];
    ASSERT_EQ(orientation(a, b, c), sign) << i;
  }
  for (const int count : seen) EXPECT_GT(count, 3000);
}

TEST(Orientation, InThePlaneIsExactWhateverTheSizes) {
  for (const double size : {1e-160, 1e-100, 1e-20, 1.0, 1e20, 1e99}) {
    const Vec2d a{size, size}, b{3 * size, 3 * size}, above{2 * size, 2 * size * (1 + 0x1p-52)};
    EXPECT_EQ(orientation(a, b, {2 * size, 2 * size}), exact(a, b, {2 * size, 2 * size})) << size;
    EXPECT_EQ(orientation(a, b, above), 1) << size;
    EXPECT_EQ(orientation({size, 1e-30}, {-size, -1e-30}, {0, 0}), 0) << size;
    EXPECT_EQ(orientation({size, 1e-300}, {-size, -2e-300}, {0, 0}), -1) << size;
  }
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
