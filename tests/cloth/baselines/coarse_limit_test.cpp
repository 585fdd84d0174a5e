#include "weft/cloth/baselines/coarse_limit.h"

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "weft/cloth/baselines/strain_limit.h"
#include "weft/cloth/measure.h"

namespace weft {
namespace {

using namespace testing;

constexpr double limit = 0.05;

/// A sheet twice as long as it should be, held by one side.
ClothState pulled_long(const Cloth& cloth) {
  ClothState state = rest_state(cloth);
  for (int s = 0; s < cloth.size * cloth.size; ++s) {
    const Vec3f p = state.position.at(s);
    state.position.set(s, {p.x, p.y, 2 * (p.z + 0.5F) - 0.5F});
  }
  return state;
}

Cloth held_sheet(int n) {
  Cloth cloth = sheet_cloth(n);
  for (int c = 0; c < n; ++c) pin(cloth, c, vec_cast<double>(cloth.rest.at(c)));
  return cloth;
}

TEST(CoarseLimit, CarriesACorrectionThroughTheWholeClothAtOnce) {
  const int n = 65;
  const Cloth cloth = held_sheet(n);
  ThreadTeam team(1);
  const auto reach_after = [&](bool coarse) {
    ClothState state = pulled_long(cloth);
    CoarseLimit levels(cloth, team);
    for (int round = 0; round < 4; ++round) {
      if (coarse) levels.limit({.passes = 2, .strain = limit}, 1.0 / 240, state, team);
      limit_strain(cloth, {.passes = 5, .strain = limit}, 1.0 / 240, state, team);
    }
    EXPECT_EQ(state.position.at(0), cloth.rest.at(0));
    return state.position.z(n - 1, n / 2) + 0.5;
  };
  EXPECT_GT(reach_after(false), 1.7);  // the free end has not heard yet of the pins
  EXPECT_LT(reach_after(true), 1.1);
  EXPECT_GT(reach_after(true), 0.9);
}

TEST(CoarseLimit, LeavesAloneWhatIsWithinTheLimit) {
  const Cloth cloth = sheet_cloth(17);
  ClothState state = rest_state(cloth);
  shake(cloth, 0.0005, state.position);
  const std::string before = hash_of(state);
  ThreadTeam team(1);
  CoarseLimit(cloth, team).limit({.passes = 2, .strain = limit}, 1.0 / 240, state, team);
  EXPECT_EQ(hash_of(state), before);
}

TEST(CoarseLimit, KeepsMomentumAndMatesAlsoWhereMatesDoNotHalve) {
  const int n = 17;
  Planes3 rest = flat_sheet(n);
  const BorderMates odd(n, {{15, 17, 1}});
  rest.set(border_sample(n, 17), rest.at(border_sample(n, 15)));
  for (const Cloth& cloth : {sheet_cloth(n), torus_cloth(n), make_cloth(rest, odd, soft_fabric)}) {
    ClothState state = rest_state(cloth);
    for (int s = 0; s < n * n; ++s) state.position.set(s, 1.4F * state.position.at(s));
    shake(cloth, 0.02, state.position);
    shake(cloth, 20, state.velocity, 5);
    const Vec3d before = centre_of_mass(cloth, state), impulse = momentum(cloth, state);
    const std::string unlimited = hash_of(state);
    ThreadTeam team(1);
    CoarseLimit(cloth, team).limit({.passes = 2, .strain = limit}, 1.0 / 240, state, team);
    EXPECT_NE(hash_of(state), unlimited);
    EXPECT_LT(length(centre_of_mass(cloth, state) - before), 1e-6);
    EXPECT_LT(length(momentum(cloth, state) - impulse), 1e-4);
    EXPECT_TRUE(mates_equal(cloth, state));
  }
}

TEST(CoarseLimit, AnyTeamGivesTheSameBits) {
  for (const Cloth& cloth : {held_sheet(21), torus_cloth(17)}) {
    std::string first;
    for (const int threads : {1, 2, 3, 7}) {
      ClothState state = pulled_long(cloth);
      shake(cloth, 0.01, state.position);
      ThreadTeam team(threads);
      CoarseLimit(cloth, team).limit({.passes = 3, .strain = limit}, 1.0 / 240, state, team);
      if (first.empty()) first = hash_of(state);
      EXPECT_EQ(hash_of(state), first) << threads << " threads";
    }
  }
}

}  // namespace
}  // namespace weft
