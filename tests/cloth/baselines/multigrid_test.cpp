#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "weft/cloth/integrator.h"
#include "weft/cloth/measure.h"
#include "weft/error.h"

namespace weft {
namespace {

using namespace testing;

// What holds of every integrator (free fall, momentum, equal bits on any team, pins) is tested in
// stepping_test.cpp.

/// Half a second of the sheet that hangs by two corners, four substeps a frame, no limiter.
ClothState hanging_sheet(const Cloth& cloth, const MultigridOptions& options) {
  ThreadTeam team(1);
  const StepInput input;
  const auto integrator = make_integrator(options, cloth, input, team);
  ClothState state = rest_state(cloth);
  run(*integrator, input, 120, state);
  return state;
}

Cloth hung(int n) {
  Cloth cloth = sheet_cloth(n);
  for (const int s : {0, n - 1}) pin(cloth, s, vec_cast<double>(cloth.rest.at(s)));
  return cloth;
}

TEST(Multigrid, HangingSheetFallsAsItShouldAndHardlyStretches) {
  const Cloth cloth = hung(65);
  const ClothState state = hanging_sheet(cloth, {});
  EXPECT_NEAR(centre_of_mass(cloth, state).y, -0.50, 0.02);
  EXPECT_LT(measure_strain(cloth, state).p99, 0.025);
}

TEST(Multigrid, MoreIterationsChangeTheMotionLittle) {
  const Cloth cloth = hung(33);
  const ClothState few = hanging_sheet(cloth, {});
  const ClothState many = hanging_sheet(cloth, {.max_iterations = 40, .tolerance = 1e-6});
  EXPECT_LT(length(centre_of_mass(cloth, few) - centre_of_mass(cloth, many)), 0.02);
  EXPECT_LT(measure_strain(cloth, many).p99, 0.02);
}

TEST(Multigrid, StopsAtTheToleranceOrTheLimit) {
  const Cloth cloth = hung(17);
  ThreadTeam team(1);
  const auto report_of = [&](const MultigridOptions& options) {
    const auto integrator = make_integrator(options, cloth, {}, team);
    ClothState state = rest_state(cloth);
    return run(*integrator, {}, 10, state);
  };
  const StepReport capped = report_of({.max_iterations = 2, .tolerance = 0});
  EXPECT_EQ(capped.iterations, 2);
  EXPECT_GT(capped.residual, 0);
  const StepReport converged = report_of({.max_iterations = 100, .tolerance = 1e-3});
  EXPECT_LT(converged.iterations, 100);
  EXPECT_LE(converged.residual, 1e-3);
}

TEST(Multigrid, HeldParticleStaysOnItsSurfaceAndSlides) {
  const int n = 17;
  for (const Cloth& cloth : {sheet_cloth(n), torus_cloth(n)}) {
    ThreadTeam team(1);
    const StepInput input{1.0 / 60, {0, -9.81F, 0}};
    const auto integrator = make_integrator(MultigridOptions{}, cloth, input, team);
    ClothState state = rest_state(cloth, {0.6F, -1, 0});
    // A floor just below every particle, of no friction.
    std::vector<Contact> contacts;
    for (int s = 0; s < n * n; ++s)
      if (cloth.owner(s / n, s % n) > 0)
        contacts.push_back({{s}, {1}, {0, 1, 0}, cloth.rest.at(s).y - 0.001F, 0, {}});
    integrator->begin(input, state);
    EXPECT_LT(integrator->iterate({}).position.y(4, 4), cloth.rest.y(4, 4) - 0.015F);
    integrator->iterate(contacts);
    integrator->end(state);
    EXPECT_TRUE(mates_equal(cloth, state));
    for (int s = 0; s < n * n; ++s) {
      EXPECT_NEAR(state.position.at(s).y, cloth.rest.at(s).y - 0.001, 1e-4);
      EXPECT_NEAR(state.position.at(s).x, cloth.rest.at(s).x + 0.01, 1e-5);
    }
  }
}

TEST(Multigrid, PinsMayComeAndGoBetweenSteps) {
  const int n = 17;
  Cloth cloth = sheet_cloth(n);
  ThreadTeam team(1);
  const auto integrator = make_integrator(MultigridOptions{}, cloth, {}, team);
  ClothState state = rest_state(cloth);
  run(*integrator, {}, 10, state);
  const Vec3d place = vec_cast<double>(state.position.at(0));
  pin(cloth, 0, place);
  ClothState again = state;
  run(*integrator, {}, 10, state);
  EXPECT_EQ(state.position.at(0), vec_cast<float>(place));
  const auto fresh = make_integrator(MultigridOptions{}, cloth, {}, team);
  run(*fresh, {}, 10, again);
  EXPECT_EQ(hash_of(again), hash_of(state));
}

TEST(Multigrid, OptionsThatMakeNoSenseNameTheirKey) {
  const Cloth cloth = sheet_cloth(9);
  ThreadTeam team(1);
  const auto message = [&](const MultigridOptions& options) -> std::string {
    try {
      make_integrator(options, cloth, {}, team);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message({.max_iterations = 0}).find("integrator.max_iterations"), std::string::npos);
  EXPECT_NE(message({.tolerance = -1}).find("integrator.tolerance"), std::string::npos);
  EXPECT_NE(message({.tolerance = nan}).find("integrator.tolerance"), std::string::npos);
  EXPECT_EQ(message({}), "");
}

}  // namespace
}  // namespace weft
