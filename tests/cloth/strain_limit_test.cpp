#include "weft/cloth/strain_limit.h"

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "weft/cloth/measure.h"

namespace weft {
namespace {

using namespace testing;

ClothState stretched(const Cloth& cloth, float by) {
  ClothState state = rest_state(cloth);
  for (int s = 0; s < cloth.size * cloth.size; ++s) {
    const Vec3f p = state.position.at(s);
    state.position.set(s, {by * p.x, p.y, p.z});
  }
  shake(cloth, 0.01, state.position);
  return state;
}

TEST(StrainLimit, EnoughPassesBringEverySpringWithinTheLimit) {
  for (const Cloth& cloth : {sheet_cloth(9), torus_cloth(13)}) {
    ClothState state = stretched(cloth, 1.3F);
    ThreadTeam team(1);
    EXPECT_GT(measure_strain(cloth, state).max, 0.2);
    limit_strain(cloth, {.passes = 2000}, 1.0 / 240, state, team);
    EXPECT_LT(measure_strain(cloth, state).max, 0.0505);
  }
}

TEST(StrainLimit, CompressedSpringsAreLimitedToo) {
  const Cloth cloth = sheet_cloth(9);
  ClothState state = stretched(cloth, 0.8F);
  ThreadTeam team(1);
  limit_strain(cloth, {.passes = 2000}, 1.0 / 240, state, team);
  EXPECT_LT(measure_strain(cloth, state).max, 0.0505);
}

TEST(StrainLimit, OneSpringEndsExactlyAtTheLimit) {
  Planes3 rest = flat_sheet(2);
  const Cloth cloth = make_cloth(rest, no_mates(2), soft_fabric);
  ClothState state = rest_state(cloth);
  for (const int r : {0, 1}) state.position.x(r, 1) += 1;
  ThreadTeam team(1);
  const double h = 0.01;
  limit_strain(cloth, {.passes = 300}, h, state, team);
  EXPECT_NEAR(state.position.x(0, 1) - state.position.x(0, 0), 1.05, 1e-3);
  // What moved a particle also changed its velocity, over the step.
  EXPECT_NEAR(state.velocity.x(0, 0), (state.position.x(0, 0) - rest.x(0, 0)) / h, 1e-3);
}

TEST(StrainLimit, KeepsTheCentreOfMassAndMomentum) {
  for (const Cloth& cloth : {sheet_cloth(17), torus_cloth(17)}) {
    ClothState state = stretched(cloth, 1.2F);
    const Vec3d before = centre_of_mass(cloth, state);
    ThreadTeam team(1);
    limit_strain(cloth, {.passes = 20}, 1.0 / 240, state, team);
    EXPECT_NEAR(length(centre_of_mass(cloth, state) - before), 0, 1e-7);
    EXPECT_NEAR(length(momentum(cloth, state)), 0, 1e-5);
    EXPECT_GT(kinetic_energy(cloth, state), 0.1);
  }
}

TEST(StrainLimit, PinsStayAndMatesStayEqual) {
  const int n = 17;
  Cloth cloth = torus_cloth(n);
  pin(cloth, 0, {});
  ClothState state = stretched(cloth, 1.2F);
  const Vec3f before = state.position.at(0);
  ThreadTeam team(2);
  limit_strain(cloth, {}, 1.0 / 240, state, team);
  EXPECT_EQ(state.position.at(0), before);
  EXPECT_EQ(state.velocity.at(0), (Vec3f{}));
  EXPECT_TRUE(mates_equal(cloth, state));
}

TEST(StrainLimit, LimitOfZeroTurnsItOff) {
  const Cloth cloth = sheet_cloth(9, {.strain_limit = 0});
  ClothState state = stretched(cloth, 1.2F);
  const std::string before = hash_of(state);
  ThreadTeam team(1);
  limit_strain(cloth, {}, 1.0 / 240, state, team);
  EXPECT_EQ(hash_of(state), before);
}

TEST(StrainLimit, AnyTeamGivesTheSameBits) {
  for (const Cloth& cloth : {sheet_cloth(21), torus_cloth(17)}) {
    std::string first;
    for (const int threads : {1, 2, 3, 7}) {
      ClothState state = stretched(cloth, 1.2F);
      ThreadTeam team(threads);
      limit_strain(cloth, {.passes = 3}, 1.0 / 240, state, team);
      if (first.empty()) first = hash_of(state);
      EXPECT_EQ(hash_of(state), first) << threads << " threads";
    }
  }
}

}  // namespace
}  // namespace weft
