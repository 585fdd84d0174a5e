#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/cloth/newton_system.h"
#include "tests/cloth/sheets.h"
#include "weft/cloth/integrator.h"
#include "weft/cloth/measure.h"
#include "weft/cloth/newton/newton_solver.h"
#include "weft/error.h"

namespace weft {
namespace {

using namespace testing;

constexpr Vec3d gravity{0, -9.81, 0};

double energy_of(const Cloth& cloth, const ClothState& state) {
  return kinetic_energy(cloth, state) + potential_energy(cloth, state, gravity);
}

TEST(Newton, AtRestNothingMovesWhateverTheIterations) {
  for (const Cloth& cloth :
       {sheet_cloth(33, cotton), torus_cloth(33, cotton), sheet_cloth(30, hard)})
    for (const int iterations : {1, 2, 50}) {
      ThreadTeam team(1);
      const auto integrator = make_integrator(
          NewtonOptions{.max_iterations = iterations, .tolerance = 0}, cloth, {}, team);
      ClothState state = rest_state(cloth);
      run(*integrator, {.time_step = step, .gravity = {}}, 20, state);
      double farthest = 0;
      for (int s = 0; s < cloth.size * cloth.size; ++s)
        farthest = std::max(farthest, double{length(state.position.at(s) - cloth.rest.at(s))});
      // Normals of a curved rest shape round by parts in a million of its radius.
      EXPECT_LT(farthest, cloth.bending.curved ? 1e-5 : 1e-7)
          << cloth.size << ", " << iterations << " iterations";
      EXPECT_LT(kinetic_energy(cloth, state), 1e-9 * total_mass(cloth) * 9.81);
    }
}

TEST(Newton, FreeFallIsExact) {
  for (const Cloth& cloth :
       {sheet_cloth(33, hard), torus_cloth(17, cotton), sheet_cloth(20, woven)}) {
    ThreadTeam team(1);
    const auto integrator = make_integrator(NewtonOptions{}, cloth, {}, team);
    ClothState state = rest_state(cloth, {0.5F, 1, -0.25F});
    const int steps = 24;
    run(*integrator, {.time_step = step}, steps, state);
    const double t = steps * step;
    const Vec3d fallen = t * Vec3d{0.5, 1, -0.25} + (0.5 * t * (t + step)) * gravity;
    for (int s = 0; s < cloth.size * cloth.size; ++s)
      ASSERT_LT(length(vec_cast<double>(state.position.at(s) - cloth.rest.at(s)) - fallen), 4e-6);
  }
}

TEST(Newton, LongStepsAreLinearisedOnceWhereNothingBends) {
  const Cloth cloth = sheet_cloth(33, cotton);
  ThreadTeam team(1);
  const auto integrator = make_integrator(NewtonOptions{}, cloth, {}, team);
  ClothState state = rest_state(cloth, {0.5F, 1, -0.25F});
  integrator->begin({.time_step = 1.0 / 60}, state);
  integrator->iterate({});
  EXPECT_EQ(integrator->end(state).iterations, 1);
}

TEST(Newton, FewIterationsKeepMomentumOfAllThatFlies) {
  const Cloth cloth = sheet_cloth(33, cotton);
  ThreadTeam team(1);
  const auto integrator = make_integrator(NewtonOptions{.max_iterations = 1}, cloth, {}, team);
  ClothState state = rest_state(cloth);
  shake(cloth, 0.3 * cloth.rest_spacing, state.position);
  run(*integrator, {.time_step = step, .gravity = {}}, 20, state);
  // Springs that shaking strained by 30 % drive particles at metres a second, in all directions.
  EXPECT_LT(length(momentum(cloth, state)), 1e-4 * total_mass(cloth));
}

/// A square sheet of this side.
Cloth square_of(double side, const Material& material) {
  Planes3 positions = flat_sheet(33);
  for (int s = 0; s < 33 * 33; ++s) positions.set(s, static_cast<float>(side) * positions.at(s));
  return make_cloth(positions, no_mates(33), material);
}

/// A sheet that is hung by two corners falls for so many frames, by the defaults and beside that
/// to the end of each step.
void expect_as_tight(const Material& material, int substeps, int frames, double side = 1) {
  Cloth cloth = square_of(side, material);
  hang(cloth);
  ThreadTeam team(1);
  const auto usual = make_integrator(NewtonOptions{}, cloth, {}, team);
  const auto tight =
      make_integrator(NewtonOptions{.max_iterations = 40, .tolerance = 1e-6}, cloth, {}, team);
  ClothState state = rest_state(cloth), exact = rest_state(cloth);
  const StepInput input{.time_step = 1.0 / (60 * substeps)};
  for (int frame = 0; frame < frames; ++frame) {
    run(*usual, input, substeps, state);
    for (int i = 0; i < substeps; ++i) {
      tight->begin(input, exact);
      for (int k = 0; k < 4; ++k) tight->iterate({});
      tight->end(exact);
    }
    EXPECT_LT(length(centre_of_mass(cloth, state) - centre_of_mass(cloth, exact)), 0.005 * side)
        << frame << ", " << substeps << " substeps";
    if (side == 1 && frame == 29) {
      EXPECT_LT(centre_of_mass(cloth, state).y, -0.45);
    }
  }
}

TEST(Newton, HangingClothFallsAsTheTightSolveDoes) {
  for (const Material& material : {cotton, hard, woven}) expect_as_tight(material, 4, 30);
}

/// One linearisation of such a step of stiff cloth loses the centre of mass by a centimetre.
TEST(Newton, HangingClothFallsAsTheTightSolveDoesInLongSteps) {
  const Material stiff{
      .density = 0.19, .stretch = {7.9e4, 5e3}, .shear = 1.2e3, .bending = 4e-6, .damping = 0};
  for (const int substeps : {1, 2}) expect_as_tight(stiff, substeps, 60);
}

/// One linearisation a step holds it back by up to a fifth of its length.
TEST(Newton, SmallStiffClothFallsAsTheTightSolveDoes) {
  const Material stiff{.density = 0.1, .stretch = 2e4, .shear = 100, .bending = 1e-6, .damping = 0};
  for (const double side : {0.05, 0.1, 0.3}) expect_as_tight(stiff, 4, 12, side);
}

TEST(Newton, CautionsWhereRoundingHoldsClothBack) {
  ThreadTeam team(1);
  const auto caution = [&](double stretch) {
    const Cloth cloth = sheet_cloth(17, {.density = 0.2, .stretch = stretch});
    return make_integrator(NewtonOptions{}, cloth, {}, team)->caution();
  };
  EXPECT_EQ(caution(1e7), "");
  EXPECT_NE(caution(1e8).find("a stretch of 1e+08 N/m"), std::string::npos);
}

TEST(Newton, NoMaterialAndNoStepGainsEnergy) {
  Random random(7);
  const auto between = [&](double min, double max) {
    double value = min;
    // Log-uniform without a logarithm: a random power of two, then uniform within it.
    const int doublings = static_cast<int>(random.uniform(0, 30));
    for (int i = 0; i < doublings && 2 * value < max; ++i) value *= 2;
    return std::min(max, value * random.uniform(1, 2));
  };
  for (int run_index = 0; run_index < 24; ++run_index) {
    Material material;
    material.density = between(0.02, 1);
    material.stretch = {between(2000, 100000), between(2000, 100000)};
    material.shear = between(10, 2000);
    material.bending = {between(1e-6, 1e-4), between(1e-6, 1e-4)};
    material.damping = run_index % 3 == 0 ? 0 : between(0.5, 5);
    material.strain_limit = run_index % 8 == 0 ? 0.02 : 0;
    const int n = 17 + static_cast<int>(random.uniform(0, 17));
    const int substeps = 1 + static_cast<int>(random.uniform(0, 16));
    Cloth cloth = sheet_cloth(n, material);
    hang(cloth);
    ThreadTeam team(1);
    const auto integrator = make_integrator(NewtonOptions{}, cloth, {}, team);
    ClothState state = rest_state(cloth);
    const StepInput input{.time_step = 1.0 / (60 * substeps)};
    double min = energy_of(cloth, state), gained = 0;
    for (int i = 0; i < 60 * substeps; ++i) {
      run(*integrator, input, 1, state);
      const double energy = energy_of(cloth, state);
      min = std::min(min, energy);
      gained = std::max(gained, energy - min);
    }
    EXPECT_LT(gained, 1e-3 * total_mass(cloth) * 9.81)
        << run_index << ": n " << n << ", substeps " << substeps << ", density "
        << material.density;
  }
}

TEST(Newton, ThreadsAndInstructionSetsGiveTheSameBits) {
  Cloth hung = sheet_cloth(97, woven);
  hang(hung);
  Cloth carried = hung;
  for (Pin& pin : carried.pins) pin.target += Vec3d{0.002, 0.001, 0};
  const Cloth torus = torus_cloth(40, cotton);
  for (const Cloth* cloth : std::initializer_list<const Cloth*>{&hung, &carried, &torus}) {
    std::string first;
    for (const InstructionSet set : instruction_sets())
      for (const int threads : {1, 2, 3, 7}) {
        if (!has_instruction_set(set)) continue;
        ThreadTeam team({threads, set});
        const auto integrator = make_integrator(NewtonOptions{}, *cloth, {}, team);
        ClothState state = rest_state(*cloth, {0.1F, 0, 0});
        shake(*cloth, 0.1 * cloth->rest_spacing, state.position);
        run(*integrator, {.time_step = step}, 6, state);
        EXPECT_TRUE(mates_equal(*cloth, state));
        if (first.empty()) first = hash_of(state);
        EXPECT_EQ(hash_of(state), first) << name_of(set) << ", " << threads;
      }
  }
}

/// A point is pushed along its sheet, by 3 mm in a step of a millisecond.
TEST(Newton, AFirmContactHoldsAgainstSpringsThatAreStretched) {
  const Cloth cloth = sheet_cloth(17, cotton);
  const int middle = 8 * 17 + 8;
  const auto way_with = [&](float firmness) {
    ThreadTeam team(1);
    const auto integrator = make_integrator(NewtonOptions{}, cloth, {}, team);
    Contact contact;
    contact.samples[0] = middle;
    contact.normal = {1, 0, 0};
    contact.offset = 0.003F;
    contact.surface_displacement = {0.003F, 0, 0};
    contact.firmness = firmness;
    integrator->begin({.time_step = 1e-3, .gravity = {}}, rest_state(cloth));
    return integrator->iterate(std::array{contact}).position.at(middle).x;
  };
  EXPECT_LT(way_with(1), 0.0012F);
  EXPECT_GT(way_with(64), 0.002F);
}

/// A corner of a sheet that flies is stopped within one long step.
TEST(Newton, TellsWhatEnergyABlowLeavesInTheCloth) {
  int told = 0;
  for (const Material& material : {cotton, hard, woven})
    for (const float speed : {2.0F, 5.0F, 10.0F})
      for (const double time_step : {1.0 / 60, 1.0 / 120}) {
        const Cloth cloth = sheet_cloth(33, material);
        ThreadTeam team(1);
        const auto integrator = make_integrator(NewtonOptions{}, cloth, {}, team);
        ClothState state = rest_state(cloth, {0, -speed, 0});
        const double before = energy_of(cloth, state);
        Contact corner;
        corner.normal = {0, 1, 0};
        corner.offset = state.position.y.row(0)[0];
        integrator->begin({.time_step = time_step}, state);
        integrator->iterate(std::span(&corner, 1));
        const double missed = integrator->missed();
        integrator->end(state);
        EXPECT_LT(energy_of(cloth, state) - before - missed, 1e-4 * total_mass(cloth) * 9.81)
            << speed << " m/s, " << time_step << " s";
        told += missed > 0 ? 1 : 0;
      }
  EXPECT_GT(told, 0);
}

TEST(Newton, AStrainLimitHoldsWhatStretchesFar) {
  const auto stretch_of = [](double limit) {
    Cloth cloth =
        sheet_cloth(33, {.density = 1, .stretch = 200, .shear = 50, .strain_limit = limit});
    hang(cloth);
    ThreadTeam team(1);
    const auto integrator = make_integrator(NewtonOptions{}, cloth, {}, team);
    ClothState state = rest_state(cloth);
    double worst = 0;  // of a swing: what one moment tells is chance
    for (int i = 0; i < 24; ++i) {
      run(*integrator, {.time_step = step}, 10, state);
      worst = std::max(worst, measure_strain(cloth, state).p99);
    }
    return worst;
  };
  const double free = stretch_of(0), limited = stretch_of(0.03);
  EXPECT_GT(free, 0.3);
  // Beside the pins, where weight gathers, springs go beyond the limit, but not far: 0.40 of it.
  EXPECT_LT(limited, 0.42 * free);
}

TEST(Newton, PinsGoWhereTheyAreTaken) {
  Cloth cloth = sheet_cloth(33, cotton);
  hang(cloth);
  ThreadTeam team(1);
  const auto integrator = make_integrator(NewtonOptions{}, cloth, {}, team);
  ClothState state = rest_state(cloth);
  for (int i = 0; i < 60; ++i) {
    for (Pin& held : cloth.pins) held.target.x += 0.002;
    run(*integrator, {.time_step = step}, 1, state);
    for (const Pin& held : cloth.pins)
      ASSERT_EQ(state.position.at(held.sample), vec_cast<float>(held.target));
  }
  EXPECT_LT(measure_strain(cloth, state).p99, 0.02);
}

TEST(Newton, WhatIsForgottenShowsNowhere) {
  Cloth cloth = sheet_cloth(33, cotton);
  hang(cloth);
  ThreadTeam team(1);
  const StepInput input{.time_step = step};
  const auto used = make_integrator(NewtonOptions{}, cloth, {}, team);
  ClothState state = rest_state(cloth);
  run(*used, input, 10, state);
  ClothState anew = rest_state(cloth), going_on = rest_state(cloth);
  for (ClothState* copy : {&anew, &going_on}) *copy = state;
  const auto fresh = make_integrator(NewtonOptions{}, cloth, {}, team);
  run(*fresh, input, 4, anew);
  used->forget();
  run(*used, input, 4, going_on);
  EXPECT_EQ(hash_of(going_on), hash_of(anew));
}

TEST(Newton, ThePathBeforeSavesIterations) {
  ThreadTeam team(1);
  int iterations[2]{};
  for (const Material& material : {cotton, hard, woven}) {
    Cloth cloth = sheet_cloth(33, material);
    hang(cloth);
    for (const bool forgets : {false, true}) {
      const auto integrator = make_integrator(NewtonOptions{}, cloth, {}, team);
      ClothState state = rest_state(cloth);
      for (int i = 0; i < 60; ++i) {
        if (forgets) integrator->forget();
        integrator->begin({.time_step = step}, state);
        integrator->iterate({});
        iterations[forgets ? 1 : 0] += integrator->end(state).iterations;
      }
    }
  }
  EXPECT_LT(iterations[0], 0.8 * iterations[1]);
}

TEST(Newton, RefusesOptionsOutOfRange) {
  const Cloth cloth = sheet_cloth(9);
  ThreadTeam team(1);
  EXPECT_THROW(make_integrator(NewtonOptions{.max_iterations = 0}, cloth, {}, team), SceneError);
  EXPECT_THROW(make_integrator(NewtonOptions{.tolerance = -1}, cloth, {}, team), SceneError);
}

}  // namespace
}  // namespace weft
