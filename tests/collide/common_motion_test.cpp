#include "weft/collide/filter/common_motion.h"

#include <gtest/gtest.h>

#include "tests/collide/test_bodies.h"

namespace weft::common_motion_test {
namespace {

using test::TestCloth;

constexpr int side = 11;
constexpr double far_apart = 8;

/// A flat sheet of 1 m that moves.
TestCloth sheet_at(Vec3d corner, Vec3d way) {
  TestCloth cloth(side);
  cloth.place([&](int r, int c) { return corner + Vec3d{0.1 * c, 0, 0.1 * r}; });
  for (int s = 0; s < side * side; ++s)
    cloth.position.set(s, vec_cast<float>(vec_cast<double>(cloth.start.at(s)) + way));
  return cloth;
}

CommonMotion motion_of(TestCloth& a, TestCloth& b) {
  CommonMotion motion;
  for (TestCloth* cloth : {&a, &b})
    motion.add(cloth->moving(), SurfaceGrid(side, BorderMates(side, {}), {}));
  motion.find(far_apart);
  return motion;
}

TEST(CommonMotion, IsThatOfEachClothFarApart) {
  TestCloth a = sheet_at({0, 1, 0}, {0, -0.04, 0}), b = sheet_at({2, 1, 0}, {0.01, 0, 0});
  const CommonMotion motion = motion_of(a, b);
  EXPECT_TRUE(motion.any());
  EXPECT_NEAR(motion.of(0).y, -0.04, 1e-7);
  EXPECT_NEAR(motion.of(1).x, 0.01, 1e-7);
  EXPECT_NEAR(motion.of(1).y, 0, 1e-7);
}

TEST(CommonMotion, IsTheMeanOfClothsBesideEachOther) {
  TestCloth a = sheet_at({0, 1, 0}, {0, -0.04, 0}), b = sheet_at({0, 1.1, 0}, {0, -0.044, 0});
  const CommonMotion motion = motion_of(a, b);
  EXPECT_NEAR(motion.of(0).y, -0.042, 1e-7);
  EXPECT_EQ(motion.of(0), motion.of(1));
}

TEST(CommonMotion, IsNoneOfWhatIsPinnedOrBesideIt) {
  TestCloth a = sheet_at({0, 1, 0}, {0, -0.04, 0}), b = sheet_at({0, 1.1, 0}, {0, -0.04, 0});
  b.inverse_mass(3, 4) = 0;
  EXPECT_FALSE(motion_of(a, b).any());
  TestCloth c = sheet_at({9, 1, 0}, {0, -0.04, 0});
  EXPECT_EQ(motion_of(b, c).of(0), Vec3d{});
  EXPECT_NE(motion_of(b, c).of(1), Vec3d{});
}

/// Samples between charts are no part of the cloth.
TEST(CommonMotion, IsThatOfChartsAlone) {
  TestCloth cloth = sheet_at({0, 1, 0}, {0, -0.04, 0});
  for (int r = 0; r < side; ++r) {
    cloth.inverse_mass(r, 5) = 0;
    cloth.position.set(r, 5, cloth.start.at(r, 5));
  }
  const BorderMates charts(side, {{"", 0, 0, side, 5}, {"", 0, 6, side, 5}}, {});
  CommonMotion motion;
  motion.add(cloth.moving(), SurfaceGrid(side, charts, {}));
  motion.find(far_apart);
  EXPECT_NEAR(motion.of(0).y, -0.04, 1e-7);
}

TEST(CommonMotion, IsNoneWhereSamplesDoNotMoveAlike) {
  TestCloth a = sheet_at({0, 1, 0}, {0, -0.04, 0}), b = sheet_at({0, 1.1, 0}, {});
  EXPECT_FALSE(motion_of(a, b).any());
}

}  // namespace
}  // namespace weft::common_motion_test
