#include "weft/sim/stepping/nearest_ways.h"

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"

namespace weft {
namespace {

using namespace testing;

constexpr int side = 5;
constexpr Vec3d upwards{0, 1, 0}, sideways{1, 0, 0};

void spread(NearestWays& ways) {
  while (ways.spread()) continue;
}

TEST(NearestWays, AreThoseOfTheNearestSample) {
  const Cloth cloth = sheet_cloth(side);
  NearestWays ways(cloth);
  ways.put(0, upwards);
  ways.put(side * side - 1, sideways);
  spread(ways);
  ASSERT_NE(ways.at(side), nullptr);
  EXPECT_EQ(*ways.at(side), upwards);
  EXPECT_EQ(*ways.at(side * side - 2), sideways);
}

TEST(NearestWays, AreNoneWhereNothingHoldsTheCloth) {
  const Cloth cloth = sheet_cloth(side);
  NearestWays ways(cloth);
  ways.put(3, upwards);
  ways.clear();
  EXPECT_FALSE(ways.spread());
  EXPECT_EQ(ways.at(3), nullptr);
}

TEST(NearestWays, GoOnAcrossSeams) {
  const Cloth cloth = torus_cloth(side);
  NearestWays ways(cloth);
  ways.put(0, upwards);  // one particle at all four corners
  ways.put(side * side / 2, sideways);
  spread(ways);
  EXPECT_EQ(*ways.at(side * side - 1), upwards);
  EXPECT_EQ(*ways.at(side * side - 2), upwards);
}

TEST(NearestWays, GoOnAcrossLayersFromTheSideThatHasOne) {
  const Cloth lower = sheet_cloth(side), upper = sheet_cloth(side);
  NearestWays below(lower), above(upper);
  Contact contact;  // of a sample above with an edge below
  contact.samples = {7, 11, 12, 0};
  contact.weights = {1, -0.5F, -0.5F, 0};
  hand_over(contact, above, below);
  EXPECT_EQ(above.at(7), nullptr);
  below.put(11, upwards);
  hand_over(contact, above, below);
  ASSERT_NE(above.at(7), nullptr);
  EXPECT_EQ(*above.at(7), upwards);
  EXPECT_EQ(below.at(12), nullptr);  // that side has one
  above.put(8, sideways);
  hand_over(contact, above, below);
  EXPECT_EQ(*above.at(7), upwards);
}

}  // namespace
}  // namespace weft
