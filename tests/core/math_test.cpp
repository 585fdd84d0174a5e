#include "weft/core/math.h"

#include <cmath>

#include <gtest/gtest.h>

namespace weft {
namespace {

TEST(Math, SineAndCosineAreWithinRoundingOfTheLibrary) {
  double worst = 0;
  for (int i = -200000; i <= 200000; ++i) {
    const double angle = i * 1e-4;
    worst = std::fmax(worst, std::fabs(sine(angle) - std::sin(angle)));
    worst = std::fmax(worst, std::fabs(cosine(angle) - std::cos(angle)));
  }
  EXPECT_LT(worst, 4e-16);
}

TEST(Math, SineStaysAccurateForLargeAngles) {
  for (const double angle : {1e3, 12345.678, -99999.5, 1e5})
    EXPECT_NEAR(sine(angle), std::sin(angle), 1e-15) << angle;
}

TEST(Math, SineAndCosineOfAnyAngleLieOnTheCircle) {
  for (const double angle : {1e6, -3.7e9, 1e19, -1e40, 1e300}) {
    EXPECT_NEAR(sine(angle) * sine(angle) + cosine(angle) * cosine(angle), 1, 1e-15) << angle;
    EXPECT_EQ(sine(-angle), -sine(angle));
  }
  EXPECT_NEAR(sine(1e6), std::sin(1e6), 1e-9);
}

TEST(Math, SpecialAnglesAreExact) {
  EXPECT_EQ(sine(0), 0);
  EXPECT_EQ(cosine(0), 1);
  EXPECT_EQ(arc_tangent(0, 1), 0);
  EXPECT_EQ(arc_tangent(0, -1), pi);
  EXPECT_EQ(arc_tangent(1, 0), pi / 2);
  EXPECT_EQ(arc_tangent(-1, 0), -pi / 2);
  EXPECT_EQ(arc_tangent(0, 0), 0);
}

TEST(Math, ArcTangentIsWithinRoundingOfTheLibraryInAllQuadrants) {
  double worst = 0;
  for (int i = 0; i < 40000; ++i) {
    const double angle = (i - 20000) * pi / 20000 + 1e-5;
    const double x = std::cos(angle) * (1 + i), y = std::sin(angle) * (1 + i);
    worst = std::fmax(worst, std::fabs(arc_tangent(y, x) - std::atan2(y, x)));
  }
  EXPECT_LT(worst, 9e-16);
}

TEST(Math, ArcCosineInvertsCosineAndClamps) {
  for (int i = 1; i < 1000; ++i)
    EXPECT_NEAR(arc_cosine(cosine(i * pi / 1000)), i * pi / 1000, 1e-13);
  EXPECT_EQ(arc_cosine(2), 0);
  EXPECT_EQ(arc_cosine(-2), pi);
}

}  // namespace
}  // namespace weft
