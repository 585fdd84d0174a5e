#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "weft/cloth/integrator.h"
#include "weft/cloth/measure.h"

namespace weft {
namespace {

using namespace testing;

TEST(Implicit, NeedsNoCorrectionInFreeFall) {
  const Cloth cloth = sheet_cloth(17);
  ThreadTeam team(1);
  const auto integrator = make_integrator(ImplicitOptions{}, cloth, {}, team);
  ClothState state = rest_state(cloth);
  const StepReport report = run(*integrator, {}, 1, state);
  EXPECT_EQ(report.iterations, 0);
  EXPECT_EQ(report.residual, 0);
}

TEST(Implicit, EulerDampsASpringByTheKnownFactor) {
  // Two columns joined by two springs along x: w^2 = 2 k / m; a step takes 1 + w^2 h^2 off the
  // energy.
  Material material{.stretch = 50, .shear = 0, .bend_springs = 0, .damping = 0};
  const Cloth cloth = make_cloth(flat_sheet(2), no_mates(2), material);
  ThreadTeam team(1);
  StepInput input{1.0 / 240, {}};
  const auto integrator = make_integrator(ImplicitOptions{.tolerance = 1e-8}, cloth, input, team);
  ClothState state = rest_state(cloth);
  for (const int r : {0, 1})
    for (const int c : {0, 1}) state.position.x(r, c) *= 1.02F;
  const auto energy = [&] {
    return kinetic_energy(cloth, state) + potential_energy(cloth, state, {});
  };
  const double w2 = 2 * (material.stretch.warp / 2) / cloth.mass(0, 0);
  const double factor = 1 + w2 * input.time_step * input.time_step;
  for (int step = 0; step < 20; ++step) {
    const double before = energy();
    run(*integrator, input, 1, state);
    EXPECT_NEAR(before / energy(), factor, 1e-3 * factor) << "step " << step;
  }
}

TEST(Implicit, IterationsHardlyGrowWithTheImage) {
  const auto iterations = [](int n) {
    Cloth cloth = sheet_cloth(n);
    pin(cloth, 0, vec_cast<double>(cloth.rest.at(0)));
    pin(cloth, n - 1, vec_cast<double>(cloth.rest.at(n - 1)));
    ThreadTeam team(1);
    const StepInput input;
    const auto integrator = make_integrator(ImplicitOptions{.tolerance = 1e-4}, cloth, input, team);
    ClothState state = rest_state(cloth);
    int sum = 0;
    for (int step = 0; step < 12; ++step) sum += run(*integrator, input, 1, state).iterations;
    return sum;
  };
  const int coarse = iterations(17);
  EXPECT_GT(coarse, 12);
  // Without the coarse levels it takes four times as many and more, some 80 a step.
  EXPECT_LT(iterations(65), 3 * coarse);
  EXPECT_LT(iterations(65), 12 * 15);
}

TEST(Implicit, ReachesTheSameStepWithMatesThatDoNotHalve) {
  // Mates around a corner; at odd places there is no mip pyramid, yet the physics is the same.
  const int n = 17;
  const auto height_after = [](const BorderMates& mates) {
    Planes3 rest = flat_sheet(n);
    for (int k = 0; k <= mates.intervals().front().count; ++k) {
      const MateInterval& interval = mates.intervals().front();
      rest.set(border_sample(n, interval.mate - k), rest.at(border_sample(n, interval.first + k)));
    }
    Cloth cloth = make_cloth(rest, mates, soft_fabric);
    pin(cloth, n * n / 2, vec_cast<double>(rest.at(n * n / 2)));
    ThreadTeam team(1);
    const StepInput input;
    const auto integrator = make_integrator(ImplicitOptions{.tolerance = 1e-5}, cloth, input, team);
    ClothState state = rest_state(cloth);
    run(*integrator, input, 24, state);
    EXPECT_TRUE(mates_equal(cloth, state));
    return centre_of_mass(cloth, state).y;
  };
  const double whole = height_after(BorderMates(n, {{14, 18, 2}}));
  EXPECT_NEAR(height_after(BorderMates(n, {{15, 17, 1}})), whole, 0.01 * std::abs(whole));
}

TEST(Implicit, SolvesWithManyContactsWellBelowItsCap) {
  // A sheet pressed onto a floor: the coarse levels must know of the contacts, or they push whole
  // patches through it.
  const int n = 65;
  const Cloth cloth = sheet_cloth(n);
  ThreadTeam team(1);
  const StepInput input;
  const auto integrator = make_integrator(ImplicitOptions{}, cloth, input, team);
  ClothState state = rest_state(cloth, {0, -1, 0});
  shake(cloth, 0.001, state.position);
  std::vector<Contact> contacts;
  for (int s = 0; s < n * n / 2; ++s) contacts.push_back({{s}, {1}, {0, 1, 0}, 0, 0, {}});
  integrator->begin(input, state);
  const int free = (integrator->iterate({}), integrator->end(state).iterations);
  state = rest_state(cloth, {0, -1, 0});
  shake(cloth, 0.001, state.position);
  integrator->begin(input, state);
  integrator->iterate({});
  integrator->iterate(contacts);
  const StepReport report = integrator->end(state);
  // Three solves at most, until it is known which contacts hold.
  EXPECT_LT(report.iterations - free, 3 * 60);
  EXPECT_LT(report.residual, 1e-4);
}

TEST(Implicit, IterationsStayFewWhereMatesDoNotHalve) {
  const auto iterations = [](const BorderMates& mates) {
    const int n = mates.size();
    Planes3 rest = flat_sheet(n);
    const MateInterval interval = mates.intervals().front();
    for (int k = 0; k <= interval.count; ++k)
      rest.set(border_sample(n, interval.mate - k), rest.at(border_sample(n, interval.first + k)));
    Cloth cloth = make_cloth(rest, mates, soft_fabric);
    pin(cloth, 0, vec_cast<double>(rest.at(0)));
    ThreadTeam team(1);
    const StepInput input;
    const auto integrator = make_integrator(ImplicitOptions{}, cloth, input, team);
    ClothState state = rest_state(cloth);
    int sum = 0;
    for (int step = 0; step < 12; ++step) sum += run(*integrator, input, 1, state).iterations;
    return sum;
  };
  const int n = 65;
  EXPECT_LT(iterations(BorderMates(n, {{n - 10, n + 8, 9}})), 12 * 25);
}

}  // namespace
}  // namespace weft
