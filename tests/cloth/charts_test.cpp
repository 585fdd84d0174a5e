#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/cloth/cut_sheet.h"
#include "tests/cloth/newton_system.h"
#include "weft/cloth/bending.h"
#include "weft/cloth/energy_meter.h"
#include "weft/cloth/integrator.h"
#include "weft/cloth/measure.h"
#include "weft/cloth/wind.h"
#include "weft/error.h"

namespace weft {
namespace {

using namespace testing;

struct Case {
  std::string name;
  std::vector<Chart> (*parts)(int samples);
  int samples;
  /// Seams that fall between coarse nodes cost iterations.
  double iterations;
};

const std::vector<Case> cases{{"quarters", quarters, 65, 1.2},
                              {"pinwheel", pinwheel, 65, 1.2},
                              {"odd_pinwheel", pinwheel, 54, 2}};

/// An uncut sheet and the same in charts, shaken alike.
struct Pair {
  CutSheet sheet;
  Cloth whole, cloth;
  ClothState at, here;  ///< of the uncut sheet, of the charts

  Pair(const Case& of, const Material& material)
      : sheet(of.samples, of.parts(of.samples)),
        whole(sheet_cloth(of.samples, material)),
        cloth(make_cloth(sheet.rest, sheet.mates, material)),
        at(rest_state(whole)),
        here(rest_state(cloth)) {
    shake(whole, 0.2 * whole.rest_spacing, at.position);
    here.position = sheet.cut(at.position);
  }
};

TEST(ClothCharts, SeamsJoinAllOfTheSheetAgain) {
  for (const Case& one : cases) {
    const CutSheet sheet(one.samples, one.parts(one.samples));
    const Cloth cloth = make_cloth(sheet.rest, sheet.mates, cotton);
    EXPECT_EQ(cloth.particles, one.samples * one.samples) << one.name;
    EXPECT_TRUE(sheet.mates.keep_manifold()) << one.name;
    EXPECT_NEAR(total_mass(cloth), cotton.density, 1e-6) << one.name;
    EXPECT_NEAR(cloth.rest_spacing, 1.0 / (one.samples - 1), 1e-6) << one.name;
  }
}

TEST(ClothCharts, EnergiesAreThoseOfTheUncutSheet) {
  for (const Case& one : cases)
    for (const Material& material : {cotton, woven}) {
      const Pair pair(one, material);
      const double energy = potential_energy(pair.whole, pair.at, {});
      const double bending = bending_energy(pair.whole, pair.at.position);
      EXPECT_NEAR(potential_energy(pair.cloth, pair.here, {}), energy, 1e-6 * energy) << one.name;
      EXPECT_NEAR(bending_energy(pair.cloth, pair.here.position), bending, 1e-5 * bending);
      const StrainSummary wanted = measure_strain(pair.whole, pair.at);
      const StrainSummary found = measure_strain(pair.cloth, pair.here);
      EXPECT_NEAR(found.p99, wanted.p99, 1e-6) << one.name;
      EXPECT_NEAR(found.mean, wanted.mean, 1e-6) << one.name;
    }
}

TEST(ClothCharts, WindBlowsOnNothingBetweenThem) {
  const WindOptions options{.velocity = {3, 8, 1}, .drag = 1.2, .lift = 0.4};
  for (const Case& one : cases) {
    Pair pair(one, cotton);
    ThreadTeam team(1);
    Wind(options, pair.whole).blow(step, pair.at, team);
    Wind(options, pair.cloth).blow(step, pair.here, team);
    for (int s = 0; s < pair.cloth.size * pair.cloth.size; ++s) {
      const int there = pair.sheet.uncut[static_cast<std::size_t>(s)];
      if (there < 0) continue;
      ASSERT_NEAR(length(pair.here.velocity.at(s) - pair.at.velocity.at(there)), 0, 1e-5)
          << one.name << ' ' << s;
    }
  }
}

TEST(ClothCharts, CyclesConvergeAsOnTheUncutSheet) {
  for (const Case& one : cases)
    for (const Material& material : {cotton, hard}) {
      const Pair pair(one, material);
      const int uncut = System(pair.whole).iterations_to_a_hundredth();
      EXPECT_LE(System(pair.cloth).iterations_to_a_hundredth(), one.iterations * uncut) << one.name;
    }
}

TEST(ClothCharts, HangingSheetsFallAlike) {
  for (const Case& one : cases) {
    const CutSheet sheet(one.samples, one.parts(one.samples));
    Cloth whole = sheet_cloth(one.samples, cotton);
    Cloth cloth = make_cloth(sheet.rest, sheet.mates, cotton);
    for (const int corner : {0, one.samples - 1}) {
      pin(whole, corner, vec_cast<double>(whole.rest.at(corner)));
      pin(cloth, sheet.sample_of(corner), vec_cast<double>(whole.rest.at(corner)));
    }
    ThreadTeam team(1);
    const auto a = make_integrator(NewtonOptions{}, whole, {}, team);
    const auto b = make_integrator(NewtonOptions{}, cloth, {}, team);
    ClothState at = rest_state(whole), here = rest_state(cloth);
    const StepInput input{.time_step = step};
    // Later folds snap, when by chance: a sheet then differs from itself started a micrometre away.
    for (int frame = 0; frame < 14; ++frame) {
      run(*a, input, 4, at);
      run(*b, input, 4, here);
      EXPECT_NEAR(length(centre_of_mass(cloth, here) - centre_of_mass(whole, at)), 0, 3e-4)
          << one.name << ' ' << frame;
      ASSERT_TRUE(mates_equal(cloth, here)) << one.name;
      if (frame != 11) continue;
      EXPECT_NEAR(measure_strain(cloth, here).p99 / measure_strain(whole, at).p99, 1, 0.1)
          << one.name;
    }
  }
}

TEST(ClothCharts, TheSameBitsOnAnyThreadsAndInstructionSets) {
  const CutSheet sheet(97, pinwheel(97));
  Cloth cloth = make_cloth(sheet.rest, sheet.mates, woven);
  pin(cloth, sheet.sample_of(0), vec_cast<double>(sheet.rest.at(sheet.sample_of(0))));
  std::string first;
  for (const InstructionSet set : instruction_sets())
    for (const int threads : {1, 2, 3, 7}) {
      if (!has_instruction_set(set)) continue;
      ThreadTeam team({threads, set});
      const auto integrator = make_integrator(NewtonOptions{}, cloth, {}, team);
      ClothState state = rest_state(cloth);
      run(*integrator, {.time_step = step}, 12, state);
      if (first.empty()) first = hash_of(state);
      EXPECT_EQ(hash_of(state), first) << threads;
    }
}

TEST(ClothCharts, SeparatePiecesFallWithoutEachOther) {
  // Two charts, no seam: one hangs, the other falls freely.
  const std::vector<Chart> charts{{"", 0, 0, 17, 17}, {"", 0, 20, 17, 13}};
  const BorderMates mates(33, charts, {});
  Planes3 rest(33);
  for (int s = 0; s < 33 * 33; ++s) {
    const int there = mates.representative(s);
    rest.set(s, {0.05F * float(there % 33), 0, 0.05F * float(there / 33)});
  }
  Cloth cloth = make_cloth(rest, mates, cotton);
  pin(cloth, 0, vec_cast<double>(rest.at(0)));
  ThreadTeam team(1);
  const auto integrator = make_integrator(NewtonOptions{}, cloth, {}, team);
  ClothState state = rest_state(cloth);
  run(*integrator, {.time_step = step}, 24, state);
  // Implicit Euler falls by g h^2 k (k + 1) / 2.
  const double fallen = 9.81 * step * step * 24 * 25 / 2;
  for (int r = 0; r < 17; ++r)
    for (int c = 20; c < 33; ++c) EXPECT_NEAR(state.position.at(r, c).y, -fallen, 1e-5);
  EXPECT_EQ(state.position.at(0, 0).y, 0);
}

TEST(ClothCharts, SideBySideAreRefused) {
  const BorderMates mates(33, {{"", 0, 0, 17, 17}, {"", 0, 17, 17, 16}}, {});
  const Cloth cloth = make_cloth(flat_sheet(33), mates, cotton);
  ThreadTeam team(1);
  EXPECT_THROW(make_integrator(NewtonOptions{}, cloth, {}, team), SceneError);
}

}  // namespace
}  // namespace weft
