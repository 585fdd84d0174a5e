#include "weft/collide/filter/impact.h"

#include <gtest/gtest.h>

#include "weft/core/random.h"

namespace weft {
namespace {

double momentum(const ImpactSides& sides) {
  double sum = 0;
  for (int k = 0; k < sides.count_a + sides.count_b; ++k)
    sum += sides.points[k].speed / sides.points[k].inverse_mass;
  return sum;
}
double energy(const ImpactSides& sides) {
  double sum = 0;
  for (int k = 0; k < sides.count_a + sides.count_b; ++k)
    sum += sides.points[k].speed * sides.points[k].speed / sides.points[k].inverse_mass;
  return sum;
}

ImpactSides random_sides(Random& random) {
  ImpactSides sides;
  sides.count_a = sides.count_b = 3;
  for (ImpactPoint& point : sides.points)
    point = {random.uniform(-1, 1), 1 / random.uniform(0.1, 2)};
  return sides;
}

TEST(Impact, KeepsMomentumLosesEnergyAndLeavesNothingApproaching) {
  Random random(1);
  int struck = 0;
  for (int i = 0; i < 2000; ++i) {
    const ImpactSides before = random_sides(random);
    ImpactSides after = before;
    strike(after);
    EXPECT_NEAR(momentum(after), momentum(before), 1e-12);
    EXPECT_LE(energy(after), energy(before) + 1e-12);
    for (int a = 0; a < 3; ++a)
      for (int b = 3; b < 6; ++b) EXPECT_GE(after.points[a].speed, after.points[b].speed - 1e-12);
    struck += energy(after) < energy(before) ? 1 : 0;
  }
  EXPECT_GT(struck, 1500);
}

TEST(Impact, EqualMassesGoOnAtTheirMean) {
  ImpactSides sides;
  sides.count_a = sides.count_b = 1;
  sides.points[0] = {-3, 2};
  sides.points[1] = {1, 2};
  strike(sides);
  EXPECT_EQ(sides.points[0].speed, -1);
  EXPECT_EQ(sides.points[1].speed, -1);
}

TEST(Impact, WhatPartsIsLeftAlone) {
  ImpactSides sides;
  sides.count_a = sides.count_b = 1;
  sides.points[0] = {1, 1};
  sides.points[1] = {-1, 1};
  strike(sides);
  EXPECT_EQ(sides.points[0].speed, 1);
  EXPECT_EQ(sides.points[1].speed, -1);
}

TEST(Impact, BodiesAndPinsGoOnAsTheyDo) {
  ImpactSides sides;
  sides.count_a = 3;
  sides.body_speed = 0.5;
  sides.points[0] = {-1, 1};
  sides.points[1] = {2, 1};
  sides.points[2] = {-1, 0};
  strike(sides);
  EXPECT_EQ(sides.points[1].speed, 2);
  EXPECT_EQ(sides.points[2].speed, -1);  // held
  // Between the body and what is held.
  EXPECT_EQ(sides.points[0].speed, -0.25);
  sides.count_a = 2;
  strike(sides);
  EXPECT_EQ(sides.points[0].speed, 0.5);
}

}  // namespace
}  // namespace weft
