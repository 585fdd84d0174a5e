#include "weft/cloth/wind.h"

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "weft/cloth/measure.h"

namespace weft {
namespace {

using namespace testing;

/// The force on a square metre of cloth at rest or in motion, from a step too short to change it.
Vec3d force_on(const Cloth& cloth, const WindOptions& wind, ClothState state) {
  const double step = 1e-7;
  const Vec3d before = momentum(cloth, state);
  ThreadTeam team(2);
  // Velocities start from zero, which holds the small changes exactly.
  Wind(wind, cloth).blow(step, state, team);
  return (1 / step) * (momentum(cloth, state) - before);
}

ClothState tilted(const Cloth& cloth, double angle) {
  ClothState state = rest_state(cloth);
  for (int s = 0; s < cloth.size * cloth.size; ++s) {
    const Vec3d p = vec_cast<double>(cloth.rest.at(s));
    state.position.set(s, vec_cast<float>(Vec3d{p.x * cosine(angle), p.x * sine(angle), p.z}));
  }
  return state;
}

TEST(Wind, PlateFaceOnFeelsItsDrag) {
  const Cloth cloth = sheet_cloth(9);
  const Vec3d force = force_on(cloth, {{0, -3, 0}, 1.2, 0.7}, rest_state(cloth));
  EXPECT_NEAR(force.y, -0.5 * air_density * 1.2 * 9, 1e-4);
  EXPECT_NEAR(force.x, 0, 1e-5);
  EXPECT_NEAR(force.z, 0, 1e-5);
}

TEST(Wind, PlateEdgeOnFeelsNone) {
  const Cloth cloth = sheet_cloth(9);
  EXPECT_LT(length(force_on(cloth, {{5, 0, 0}, 1, 1}, rest_state(cloth))), 1e-6);
}

TEST(Wind, TiltedPlateIsLiftedAcrossTheWind) {
  // The normal leans back by the angle: the plate is pushed along and up.
  const Cloth cloth = sheet_cloth(9);
  for (const double angle : {0.3, 0.8, 1.3}) {
    const Vec3d force = force_on(cloth, {{4, 0, 0}, 0.9, 0.6}, tilted(cloth, -angle));
    const double pressure = 0.5 * air_density * 16;
    EXPECT_NEAR(force.x, 0.9 * pressure * sine(angle), 1e-4);
    EXPECT_NEAR(force.y, 0.6 * pressure * sine(angle) * cosine(angle), 1e-4);
  }
}

TEST(Wind, BothSidesAreAlike) {
  const Cloth cloth = sheet_cloth(9);
  const Vec3d front = force_on(cloth, {{3, 1, 0.5}, 1, 1}, tilted(cloth, 0.4));
  const Vec3d back = force_on(cloth, {{-3, -1, -0.5}, 1, 1}, tilted(cloth, 0.4));
  EXPECT_LT(length(front + back), 1e-5);
}

TEST(Wind, ClothThatMovesWithItFeelsNone) {
  const Cloth cloth = sheet_cloth(9);
  EXPECT_LT(length(force_on(cloth, {{1, -2, 3}, 1, 1}, rest_state(cloth, {1, -2, 3}))), 1e-12);
}

TEST(Wind, BlowsOnASurfaceOnceWhereItIsSewn) {
  // The forces of air that passes in y on a closed surface: those on its top and bottom alone. By
  // symmetry they point along the wind and do not turn the torus.
  const Cloth cloth = torus_cloth(33);
  ClothState state = rest_state(cloth);
  ThreadTeam team(1);
  Wind({{0, 2, 0}, 1, 0}, cloth).blow(1e-4, state, team);
  EXPECT_TRUE(mates_equal(cloth, state));
  EXPECT_GT(momentum(cloth, state).y, 0);
  EXPECT_LT(length(angular_momentum(cloth, state)), 1e-4 * momentum(cloth, state).y);
  // |n . y| averages 2 / pi over the tube.
  const double area = total_mass(cloth) / cloth.material.density;
  const double wanted = 1e-4 * 0.5 * air_density * 4 * area * 2 / pi;
  EXPECT_NEAR(momentum(cloth, state).y / wanted, 1, 0.01);
}

TEST(Wind, NeverDrivesClothPastItself) {
  Material light;
  light.density = 0.01;
  const Cloth cloth = sheet_cloth(9, light);
  ClothState state = rest_state(cloth);
  ThreadTeam team(1);
  Wind wind({{0, 40, 0}, 1, 0}, cloth);
  float before = 0;
  for (int step = 0; step < 50; ++step) {
    wind.blow(1.0 / 30, state, team);
    const float now = state.velocity.y(4, 4);
    EXPECT_GE(now, before - 0.01);
    EXPECT_LE(now, 40);
    before = now;
  }
  EXPECT_GT(before, 35);
}

TEST(Wind, PinsKeepTheirVelocity) {
  Cloth cloth = sheet_cloth(9);
  pin(cloth, 40, {});
  ClothState state = rest_state(cloth);
  ThreadTeam team(1);
  Wind({{0, 2, 0}, 1, 1}, cloth).blow(0.01, state, team);
  EXPECT_EQ(state.velocity.at(40), (Vec3f{}));
  EXPECT_GT(state.velocity.y(0, 0), 0);
}

TEST(Wind, AnyTeamGivesTheSameBits) {
  const Cloth cloth = torus_cloth(17);
  const auto hash = [&](int threads) {
    ClothState state = rest_state(cloth);
    shake(cloth, 0.1, state.velocity);
    ThreadTeam team(threads);
    Wind({{1, 2, 3}, 1, 1}, cloth).blow(0.01, state, team);
    return hash_of(state);
  };
  EXPECT_EQ(hash(1), hash(3));
}

}  // namespace
}  // namespace weft
