#include "weft/cloth/baselines/strain_limit.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "weft/cloth/baselines/coarse_limit.h"
#include "weft/cloth/measure.h"

namespace weft {
namespace {

using namespace testing;

/// Of the limiter where nothing else is said.
constexpr double max_strain = 0.05;

ClothState stretched(const Cloth& cloth, float by) {
  ClothState state = rest_state(cloth);
  for (int s = 0; s < cloth.size * cloth.size; ++s) {
    const Vec3f p = state.position.at(s);
    state.position.set(s, {by * p.x, p.y, p.z});
  }
  shake(cloth, 0.01, state.position);
  return state;
}

/// l / r - 1, the largest over the stretch springs; at least 0.
double largest_elongation(const Cloth& cloth, const Planes3& position) {
  double largest = 0;
  for (const int d : {stretch_u, stretch_v}) {
    const SpringPlane& plane = cloth.springs[d];
    for (int r = 0; r + plane.down < cloth.size; ++r)
      for (int c = 0; c + plane.right < cloth.size; ++c) {
        const Vec3f displacement = position.at(r + plane.down, c + plane.right) - position.at(r, c);
        largest =
            std::max(largest, length(vec_cast<double>(displacement)) / plane.rest_length(r, c) - 1);
      }
  }
  return largest;
}

TEST(StrainLimit, EnoughPassesBringEverySpringWithinTheLimit) {
  for (const Cloth& cloth : {sheet_cloth(9), torus_cloth(13)}) {
    ClothState state = stretched(cloth, 1.3F);
    ThreadTeam team(1);
    EXPECT_GT(largest_elongation(cloth, state.position), 0.2);
    limit_strain(cloth, {.passes = 2000, .strain = max_strain}, 1.0 / 240, state, team);
    EXPECT_LT(largest_elongation(cloth, state.position), 0.0505);
  }
}

TEST(StrainLimit, MaterialsLimitHoldsWhereNoOtherIsGiven) {
  const Cloth cloth = sheet_cloth(9, {.strain_limit = 0.02});
  ClothState by_material = stretched(cloth, 1.2F), given = by_material;
  ThreadTeam team(1);
  limit_strain(cloth, {.passes = 2000}, 1.0 / 240, by_material, team);
  limit_strain(cloth, {.passes = 2000, .strain = 0.02}, 1.0 / 240, given, team);
  EXPECT_EQ(hash_of(by_material), hash_of(given));
  EXPECT_NEAR(largest_elongation(cloth, given.position), 0.02, 0.0005);
  given = stretched(cloth, 1.2F);
  limit_strain(cloth, {.passes = 2000, .strain = 0.08}, 1.0 / 240, given, team);
  EXPECT_NEAR(largest_elongation(cloth, given.position), 0.08, 0.002);
}

TEST(StrainLimit, ShorteningAndDiagonalsAreLimitedAsPrintedAlone) {
  const Cloth cloth = sheet_cloth(9);
  ThreadTeam team(1);
  // Rows half as long; and a sheet of rods whose corners give way.
  ClothState shortened = rest_state(cloth), sheared = rest_state(cloth);
  for (int s = 0; s < 81; ++s) {
    const Vec3f p = cloth.rest.at(s);
    shortened.position.set(s, {0.5F * p.x, 0, p.z});
    sheared.position.set(s, {p.x + 0.6F * p.z, 0, 0.8F * p.z});
  }
  for (const ClothState& before : {shortened, sheared})
    for (const bool as_printed : {false, true}) {
      ClothState after = before;
      limit_strain(cloth, {.passes = 40, .strain = max_strain, .as_printed = as_printed}, 1.0 / 240,
                   after, team);
      EXPECT_EQ(hash_of(after) == hash_of(before), !as_printed);
    }
  limit_strain(cloth, {.passes = 2000, .strain = max_strain, .as_printed = true}, 1.0 / 240,
               shortened, team);
  EXPECT_LT(measure_strain(cloth, shortened).max, 0.0505);
}

/// Two columns, pulled apart to twice their distance; how fast they part [m/s].
ClothState pulled_apart(const Cloth& cloth, float parting) {
  ClothState state = rest_state(cloth);
  for (const int r : {0, 1}) {
    state.position.x(r, 1) += 1;
    state.velocity.x(r, 0) = 3 - parting / 2;
    state.velocity.x(r, 1) = 3 + parting / 2;
  }
  return state;
}

TEST(StrainLimit, OneSpringEndsExactlyAtTheLimit) {
  const Cloth cloth = make_cloth(flat_sheet(2), no_mates(2), {});
  const double h = 0.01;
  ThreadTeam team(1);
  const auto parting_after = [&](float parting, bool as_printed) {
    ClothState state = pulled_apart(cloth, parting);
    limit_strain(cloth, {.passes = 300, .strain = max_strain, .as_printed = as_printed}, h, state,
                 team);
    EXPECT_NEAR(state.position.x(0, 1) - state.position.x(0, 0), 1.05, 1e-3);
    // What is common to a pair stays.
    EXPECT_NEAR(state.velocity.x(0, 1) + state.velocity.x(0, 0), 6, 1e-5);
    return state.velocity.x(0, 1) - state.velocity.x(0, 0);
  };
  const double whole = (2 - 1.05) / h;  // of the correction over the step
  EXPECT_NEAR(parting_after(0, true), -whole, 0.1);
  // At rest no part of it is safe; of what parts fast, all; else as much as turns it round.
  EXPECT_EQ(parting_after(0, false), 0);
  EXPECT_NEAR(parting_after(90, false), 90 - whole, 0.1);
  EXPECT_NEAR(parting_after(20, false), -20, 0.01);
  EXPECT_EQ(parting_after(-20, false), -20);
}

TEST(StrainLimit, KeepsTheCentreOfMassAndMomentum) {
  for (const Cloth& cloth : {sheet_cloth(17), torus_cloth(17)}) {
    ClothState state = stretched(cloth, 1.2F);
    shake(cloth, 10, state.velocity, 7);
    const Vec3d before = centre_of_mass(cloth, state), impulse = momentum(cloth, state);
    const std::string velocities = hash_of(state);
    ThreadTeam team(1);
    limit_strain(cloth, {.passes = 20, .strain = max_strain}, 1.0 / 240, state, team);
    EXPECT_NE(hash_of(state), velocities);
    EXPECT_NEAR(length(centre_of_mass(cloth, state) - before), 0, 1e-7);
    EXPECT_NEAR(length(momentum(cloth, state) - impulse), 0, 1e-5);
  }
}

TEST(StrainLimit, PinsStayAndMatesStayEqual) {
  const int n = 17;
  Cloth cloth = torus_cloth(n);
  pin(cloth, 0, {});
  for (const bool as_printed : {false, true}) {
    ClothState state = stretched(cloth, 1.2F);
    shake(cloth, 1, state.velocity);
    const Vec3f place = state.position.at(0), speed = state.velocity.at(0);
    ThreadTeam team(2);
    limit_strain(cloth, {.strain = max_strain, .as_printed = as_printed}, 1.0 / 240, state, team);
    EXPECT_EQ(state.position.at(0), place);
    EXPECT_EQ(state.velocity.at(0), speed);
    EXPECT_TRUE(mates_equal(cloth, state));
  }
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
  for (const Cloth& cloth : {sheet_cloth(21), torus_cloth(17)})
    for (const bool as_printed : {false, true}) {
      std::string first;
      for (const InstructionSet set : instruction_sets())
        for (const int threads : {1, 2, 3, 7}) {
          if (!has_instruction_set(set)) continue;
          ClothState state = stretched(cloth, 1.2F);
          shake(cloth, 3, state.velocity);
          ThreadTeam team({threads, set});
          limit_strain(cloth, {.passes = 3, .strain = max_strain, .as_printed = as_printed},
                       1.0 / 240, state, team);
          if (first.empty()) first = hash_of(state);
          EXPECT_EQ(hash_of(state), first) << threads << " threads, " << name_of(set);
        }
    }
}

/// What limits a cloth: both parts, as two_level has them.
void limit_both(const Cloth& cloth, const LimitOptions& options, double step, ClothState& state) {
  ThreadTeam team(1);
  LimitOptions coarse = options;
  coarse.passes = 2;
  CoarseLimit(cloth, team).limit(coarse, step, state, team);
  limit_strain(cloth, options, step, state, team);
}

TEST(StrainLimit, NeverLendsKineticEnergyToRandomStates) {
  Random random(11);
  const auto decades = [&](double from, double to) {
    return std::pow(10.0, random.uniform(from, to));
  };
  int changed = 0, held_back = 0;
  for (int draw = 0; draw < 200; ++draw) {
    const int n = 5 + draw % 17;
    Cloth cloth = draw % 2 == 0 ? sheet_cloth(n, {.density = decades(-2, 0)})
                                : torus_cloth(n, {.density = decades(-2, 0)});
    for (int pins = draw % 4; pins > 0; --pins) {
      const int sample = static_cast<int>(random.uniform(0, n * n - 1e-6));
      pin(cloth, sample, vec_cast<double>(cloth.rest.at(sample)));
    }
    ClothState state = rest_state(cloth);
    const auto by = static_cast<float>(1 + random.uniform(-0.3, 1) * decades(-4, 0));
    for (int s = 0; s < n * n; ++s) state.position.set(s, by * cloth.rest.at(s));
    shake(cloth, decades(-4, 0) * cloth.rest_spacing, state.position, draw);
    shake(cloth, decades(-3, 2), state.velocity, draw + 1000);
    const ClothState before = state;
    const LimitOptions options{.passes = 1 + draw % 40, .strain = decades(-3, -1)};
    limit_both(cloth, options, 1 / (60 * decades(0, 1.5)), state);
    const double had = kinetic_energy(cloth, before), has = kinetic_energy(cloth, state);
    EXPECT_LE(has, had * (1 + 1e-6)) << "draw " << draw;
    EXPECT_TRUE(mates_equal(cloth, state)) << "draw " << draw;
    for (const Pin& held : cloth.pins) {
      EXPECT_EQ(state.position.at(held.sample), before.position.at(held.sample));
      EXPECT_EQ(state.velocity.at(held.sample), before.velocity.at(held.sample));
    }
    if (cloth.pins.empty()) {
      const double size = std::sqrt(2 * had * total_mass(cloth));
      EXPECT_LT(length(momentum(cloth, state) - momentum(cloth, before)), 1e-4 * size);
    }
    if (hash_of(state) == hash_of(before)) continue;
    ++changed;
    held_back += has > had * (1 - 1e-6) ? 1 : 0;
  }
  // What slows down and what would have sped up was among them.
  EXPECT_GT(changed, 130);
  EXPECT_GT(held_back, 20);
  EXPECT_LT(held_back, changed - 10);
}

TEST(StrainLimit, AsPrintedStaysWhatItWas) {
  // Recorded before shortening, diagonals and unsafe velocities became the printed method's alone.
  const std::vector<std::string> recorded{
      "c550d8acc7ee96e6", "2310d6da785e1f48", "bf184c17637667b3", "3b5c5f3f0dd34904",
      "8b3ec2ffa688af33", "d4f878b7ccd3a1b3", "756bbfc2fdaacbb0", "d5b1140fc3ccdcd4"};
  std::vector<std::string> found;
  for (const int n : {21, 33})
    for (Cloth cloth : {sheet_cloth(n, {.density = 0.2}), torus_cloth(n, {.density = 0.2})}) {
      pin(cloth, n + 1, vec_cast<double>(cloth.rest.at(n + 1)));
      for (const float by : {1.3F, 0.8F}) {
        ClothState state = stretched(cloth, by);
        shake(cloth, 1, state.velocity, 2);
        limit_both(cloth, {.passes = 12, .strain = max_strain, .as_printed = true}, 1.0 / 240,
                   state);
        found.push_back(hash_of(state));
      }
    }
  EXPECT_EQ(found, recorded);
}

TEST(SafeVelocities, AddTheLargestPartThatLendsNoEnergy) {
  const Cloth cloth = torus_cloth(9);
  ThreadTeam team(2);
  SafeVelocities safe(cloth, team);
  Planes3 change(9);
  shake(cloth, 1, change, 3);
  ClothState state = rest_state(cloth);
  const auto part_of = [&](const Planes3& start, double scale) {
    double part = 0;
    state.velocity = start;
    team.run([&](Worker& worker) {
      const double mine = safe.add(change, scale, state.velocity, worker);
      if (worker.rank() == 0) part = mine;
    });
    return part;
  };
  // From -c / 4: all that 1/2 c takes is safe, of c a half, of -c nothing.
  Planes3 start(9);
  for (int s = 0; s < 81; ++s) start.set(s, -0.25F * change.at(s));
  ClothState before = rest_state(cloth);
  before.velocity = start;
  const double energy = kinetic_energy(cloth, before);
  EXPECT_NEAR(part_of(start, 0.5), 1, 1e-6);
  EXPECT_NEAR(part_of(start, 1), 0.5, 1e-6);
  EXPECT_NEAR(kinetic_energy(cloth, state), energy, 1e-6 * energy);
  EXPECT_EQ(part_of(start, 0.25), 1);
  EXPECT_NEAR(kinetic_energy(cloth, state), 0, 1e-9 * energy);
  EXPECT_EQ(part_of(start, -1), 0);
  EXPECT_EQ(kinetic_energy(cloth, state), energy);
  EXPECT_EQ(part_of(Planes3(9), 1), 0);
}

}  // namespace
}  // namespace weft
