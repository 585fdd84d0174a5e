#include "weft/collide/filter/safe_positions.h"

#include <gtest/gtest.h>

#include "tests/collide/test_bodies.h"

namespace weft::safe_positions_test {
namespace {

constexpr int n = 9;

TEST(SafePositions, GoAlongWithClothButHardlyBesideTheGround) {
  test::TestCloth wall(n);
  wall.place([](int r, int c) { return Vec3d{0.1 * c, 0.1 * r, 0}; });
  const BodyContacts::Ground ground{};
  ThreadTeam team{2};
  Planes3 safe(n);
  SafePositions::find_along(wall.start, {{}, &ground}, {0, -0.04, 0}, safe, team);
  for (int s = 0; s < n * n; ++s) {
    const double height = wall.start.at(s).y;
    const double part = std::min(1.0, SafePositions::max_part_of_distance * height / 0.04);
    EXPECT_NEAR(safe.at(s).y, height - part * 0.04, 1e-6);
    EXPECT_EQ(safe.at(s).x, wall.start.at(s).x);
  }
  EXPECT_EQ(safe.at(0), wall.start.at(0));
}

TEST(SafePositions, StayWhereClothDoesNotMove) {
  test::TestCloth sheet(n);
  sheet.place([](int r, int c) { return Vec3d{0.1 * c, 1, 0.1 * r}; });
  ThreadTeam team{1};
  Planes3 safe(n);
  SafePositions::find_along(sheet.start, {}, {}, safe, team);
  for (int s = 0; s < n * n; ++s) EXPECT_EQ(safe.at(s), sheet.start.at(s));
}

}  // namespace
}  // namespace weft::safe_positions_test
