#include <string>

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "weft/cloth/baselines/stable_step.h"
#include "weft/cloth/baselines/strain_limit.h"
#include "weft/cloth/integrator.h"
#include "weft/cloth/measure.h"
#include "weft/error.h"

namespace weft {
namespace {

using namespace testing;

const std::vector<IntegratorOptions> all_integrators{ImplicitOptions{}, ExplicitOptions{},
                                                     TwoLevelOptions{.local_size = 5},
                                                     MultigridOptions{}, DesbrunOptions{}};

/// A step that explicit Euler bears on the small cloths here.
constexpr double small_step = 1e-4;
double step_for(const IntegratorOptions& options) {
  return std::holds_alternative<ExplicitOptions>(options) ? small_step : 1.0 / 240;
}

TEST(Stepping, FreeFallIsExact) {
  for (const IntegratorOptions& options : all_integrators) {
    // Rounding wakes what explicit Euler cannot hold at this step, so its cloth is softer.
    const bool soft = std::holds_alternative<ExplicitOptions>(options);
    const Cloth cloth = sheet_cloth(17, soft ? Material{.stretch = 2, .shear = 0.5} : Material{});
    ThreadTeam team(1);
    const StepInput input;
    const auto integrator = make_integrator(options, cloth, input, team);
    ClothState state = rest_state(cloth, {0.5F, 1, 0});
    const int steps = 120;
    const StepReport report = run(*integrator, input, steps, state);
    const double h = input.time_step, t = steps * h;
    for (int s = 0; s < 17 * 17; ++s) {
      const Vec3d fallen =
          vec_cast<double>(state.position.at(s)) - vec_cast<double>(cloth.rest.at(s));
      EXPECT_NEAR(fallen.x, 0.5 * t, 1e-5) << name_of(options);
      EXPECT_NEAR(fallen.y, t - 9.81 * t * (t + h) / 2, 2e-5) << name_of(options);
      EXPECT_NEAR(fallen.z, 0, 1e-6) << name_of(options);
    }
    EXPECT_LT(report.residual, 1e-5);
  }
}

TEST(Stepping, MomentumIsKept) {
  for (const IntegratorOptions& options : all_integrators)
    for (const Cloth& cloth : {sheet_cloth(17), torus_cloth(17)}) {
      ThreadTeam team(1);
      const StepInput input{small_step, {}};
      const auto integrator = make_integrator(options, cloth, input, team);
      ClothState state = rest_state(cloth);
      shake(cloth, 0.01, state.position);
      const Vec3d centre = centre_of_mass(cloth, state);
      run(*integrator, input, 100, state);
      const double speed = std::sqrt(2 * kinetic_energy(cloth, state) / total_mass(cloth));
      EXPECT_GT(speed, 1e-5) << name_of(options);
      EXPECT_LT(length(momentum(cloth, state)), 1e-4 * speed * total_mass(cloth))
          << name_of(options);
      EXPECT_LT(length(centre_of_mass(cloth, state) - centre), 1e-5) << name_of(options);
    }
}

class StableStep : public ::testing::TestWithParam<Material> {};

// Stiff against stretch, or against bending.
INSTANTIATE_TEST_SUITE_P(Materials, StableStep,
                         ::testing::Values(Material{.bending = 0, .damping = 0},
                                           Material{.bending = 20, .damping = 0}));

TEST_P(StableStep, ExplicitBreaksOnlyAboveIt) {
  const Material& material = GetParam();
  const Cloth cloth = sheet_cloth(9, material);
  ThreadTeam team(1);
  const double largest = largest_stable_step(cloth, team);
  const auto energy_after = [&](double step) {
    const StepInput input{step, {}};
    const auto integrator = make_integrator(ExplicitOptions{}, cloth, input, team);
    ClothState state = rest_state(cloth);
    shake(cloth, 1e-5, state.position);
    const double start = potential_energy(cloth, state, {});
    run(*integrator, input, 400, state);
    return kinetic_energy(cloth, state) / start;
  };
  EXPECT_FALSE(energy_after(1.1 * largest) < 1e3);  // or not a number any more
  EXPECT_LT(energy_after(0.5 * largest), 2);
  const auto integrator = make_integrator(ExplicitOptions{}, cloth, {}, team);
  EXPECT_NE(integrator->stability_advice(1.0 / 240).find("largest stable step"), std::string::npos);
  EXPECT_FALSE(is_surely_stable(cloth, largest));
  EXPECT_TRUE(is_surely_stable(cloth, 0.5 * largest));
  const auto caution_of = [&](double step) {
    return make_integrator(ExplicitOptions{}, cloth, {step, {}}, team)->caution();
  };
  EXPECT_EQ(caution_of(0.98 * largest), "");
  EXPECT_NE(caution_of(1.02 * largest).find("largest stable step"), std::string::npos);
}

TEST(Stepping, LargestStepOfOneSpringIsTwoOverItsFrequency) {
  Material material{.shear = 0, .bend_springs = 0, .damping = 0};
  const Cloth cloth = make_cloth(flat_sheet(2), no_mates(2), material);
  ThreadTeam team(1);
  const double frequency = std::sqrt(2 * (material.stretch.warp / 2) / cloth.mass(0, 0));
  EXPECT_NEAR(largest_stable_step(cloth, team) * frequency, 2, 1e-3);
}

TEST(Stepping, MatesStayBitEqualOnATorus) {
  for (const IntegratorOptions& options : all_integrators) {
    Cloth cloth = torus_cloth(17);
    pin(cloth, 0, vec_cast<double>(cloth.rest.at(0)));
    ThreadTeam team(1);
    const StepInput input{step_for(options), {0, -9.81F, 0}};
    const auto integrator = make_integrator(options, cloth, input, team);
    ClothState state = rest_state(cloth);
    shake(cloth, 0.005, state.position);
    run(*integrator, input, 50, state);
    EXPECT_TRUE(mates_equal(cloth, state)) << name_of(options);
    EXPECT_GT(kinetic_energy(cloth, state), 0);
    EXPECT_EQ(state.position.at(0), cloth.rest.at(0));
    EXPECT_EQ(state.velocity.at(0), (Vec3f{}));
  }
}

TEST(Stepping, AnyTeamGivesTheSameBits) {
  // Few iterations: teams larger than the machine wait long at every barrier.
  for (const IntegratorOptions& options :
       {IntegratorOptions(ImplicitOptions{.max_iterations = 6}), all_integrators[1],
        all_integrators[2], all_integrators[3], all_integrators[4]})
    for (Cloth cloth : {sheet_cloth(21), torus_cloth(17)}) {
      pin(cloth, 0, vec_cast<double>(cloth.rest.at(0)));
      std::string first;
      for (const int threads : {1, 2, 3, 7}) {
        ThreadTeam team(threads);
        const StepInput input{step_for(options), {0, -9.81F, 0}};
        const auto integrator = make_integrator(options, cloth, input, team);
        ClothState state = rest_state(cloth);
        shake(cloth, 0.005, state.position);
        run(*integrator, input, 3, state);
        if (first.empty()) first = hash_of(state);
        EXPECT_EQ(hash_of(state), first) << name_of(options) << ", " << threads << " threads";
      }
    }
}

TEST(Stepping, PinFollowsItsTarget) {
  for (const IntegratorOptions& options : all_integrators) {
    Cloth cloth = sheet_cloth(9);
    pin(cloth, 40, vec_cast<double>(cloth.rest.at(40)));
    ThreadTeam team(1);
    const StepInput input{small_step, {}};
    const auto integrator = make_integrator(options, cloth, input, team);
    ClothState state = rest_state(cloth);
    pin(cloth, 40, {0, 1e-4, 0});
    run(*integrator, input, 1, state);
    EXPECT_FLOAT_EQ(state.position.y(4, 4), 1e-4F) << name_of(options);
    EXPECT_NEAR(state.velocity.y(4, 4), 1, 1e-4) << name_of(options);
  }
}

TEST(Stepping, HangingSheetFallsAsItShouldWithinItsLimit) {
  const int n = 33;
  Cloth cloth = sheet_cloth(n);
  pin(cloth, 0, vec_cast<double>(cloth.rest.at(0)));
  pin(cloth, n - 1, vec_cast<double>(cloth.rest.at(n - 1)));
  ThreadTeam team(1);
  const StepInput input{1.0 / 120, {0, -9.81F, 0}};
  const auto integrator = make_integrator(ImplicitOptions{}, cloth, input, team);
  ClothState state = rest_state(cloth);
  double highest_speed = 0;
  for (int step = 0; step < 60; ++step) {
    integrator->begin(input, state);
    limit_strain(cloth, {.strain = 0.05}, input.time_step, integrator->iterate({}), team);
    integrator->end(state);
    for (const float v : {state.velocity.y(n - 1, 0), state.velocity.y(n - 1, n - 1)})
      highest_speed = std::max(highest_speed, std::abs(double{v}));
  }
  // Converged small steps give -0.49 to -0.50 m after half a second; stiff cloth falls, it does not
  // creep.
  EXPECT_NEAR(centre_of_mass(cloth, state).y, -0.49, 0.025);
  EXPECT_GT(highest_speed, 2);
  EXPECT_LT(measure_strain(cloth, state).p99, 0.05);
  EXPECT_LT(measure_strain(cloth, state).max, 0.08);
}

TEST(Stepping, ContactsHoldAParticleAtTheirSurface) {
  for (const Cloth& cloth : {sheet_cloth(9), torus_cloth(9)}) {
    ThreadTeam team(1);
    const StepInput input{1.0 / 60, {0, -9.81F, 0}};
    const auto integrator = make_integrator(ImplicitOptions{}, cloth, input, team);
    ClothState state = rest_state(cloth, {0, -1, 0});
    std::vector<Contact> contacts;
    for (int s = 0; s < 81; ++s)
      contacts.push_back({{s}, {1}, {0, 1, 0}, cloth.rest.at(s).y - 0.001F, 0, {}});
    integrator->begin(input, state);
    const ClothState& free = integrator->iterate({});
    EXPECT_LT(free.position.y(4, 4), cloth.rest.y(4, 4) - 0.015F);
    const ClothState& held = integrator->iterate(contacts);
    for (int s = 0; s < 81; ++s) EXPECT_GT(held.position.at(s).y, cloth.rest.at(s).y - 0.004F);
    integrator->end(state);
    EXPECT_TRUE(mates_equal(cloth, state));
  }
}

TEST(Stepping, ContactForcesCarryTheWeight) {
  const int n = 17;
  for (const IntegratorOptions& options :
       {IntegratorOptions(NewtonOptions{}),
        IntegratorOptions(MultigridOptions{.max_iterations = 64, .tolerance = 1e-5}),
        IntegratorOptions(ImplicitOptions{})})
    for (const Cloth& cloth : {sheet_cloth(n), make_cloth(flat_sheet(n), torus_mates(n), {})}) {
      ThreadTeam team(1);
      const StepInput input;
      const auto integrator = make_integrator(options, cloth, input, team);
      // Every particle lies on the floor, by itself or by points of triangles.
      std::vector<Contact> contacts;
      for (int s = 0; s < n * n; ++s)
        if (cloth.owner(s / n, s % n) > 0) contacts.push_back({{s}, {1}, {0, 1, 0}, 0, 0, {}});
      for (int r = 1; r + 2 < n; r += 3)
        for (int s = r * n + 1; s + 1 < (r + 1) * n; s += 2)
          contacts.push_back({{s, s + 1, s + n}, {0.5F, 0.2F, 0.3F}, {0, 1, 0}, 0, 0, {}});
      ClothState state = rest_state(cloth);
      integrator->begin(input, state);
      integrator->iterate(contacts);
      integrator->end(state);
      double sum = 0;
      for (const float force : integrator->contact_forces()) {
        EXPECT_GE(force, 0);
        sum += force;
      }
      const double weight = 9.81 * total_mass(cloth);
      // What the springs give way by, the cloth falls.
      const double carried = weight + momentum(cloth, state).y / input.time_step;
      EXPECT_NEAR(sum, carried, 0.02 * weight) << name_of(options);
    }
}

TEST(Stepping, AContactThatLiesOnAPinThrowsNothing) {
  Cloth cloth = sheet_cloth(9);
  pin(cloth, 0, vec_cast<double>(cloth.rest.at(0)));
  ThreadTeam team(1);
  const StepInput input;
  const auto integrator = make_integrator(NewtonOptions{}, cloth, input, team);
  // A point of a triangle, all but a little of it the pinned corner, that can't be lifted.
  Contact contact;
  contact.samples = {0, 1, 9};
  contact.weights = {1 - 2e-6F, 1e-6F, 1e-6F};
  contact.normal = {0, 1, 0};
  contact.offset = cloth.rest.at(0).y + 0.002F;
  contact.friction = 0.5F;
  ClothState state = rest_state(cloth);
  for (int i = 0; i < 10; ++i) {
    integrator->begin(input, state);
    integrator->iterate(std::span(&contact, 1));
    integrator->end(state);
    EXPECT_LT(length(vec_cast<double>(state.velocity.at(0, 1))), 1) << i;
    EXPECT_LT(integrator->contact_forces()[0], 100) << i;
  }
}

TEST(Stepping, VeryUnevenCellsStayFinite) {
  const int n = 33;
  Planes3 rest = flat_sheet(n);
  for (int s = 0; s < n * n; ++s) {
    const Vec3f p = rest.at(s);
    rest.set(s, {p.x * p.x * p.x, 0, p.z * std::abs(p.z)});
  }
  Cloth cloth = make_cloth(rest, no_mates(n), {});
  pin(cloth, 0, vec_cast<double>(rest.at(0)));
  for (const IntegratorOptions& options :
       {all_integrators[0], all_integrators[2], all_integrators[4]}) {
    ThreadTeam team(1);
    const StepInput input;
    const auto integrator = make_integrator(options, cloth, input, team);
    ClothState state = rest_state(cloth);
    for (int step = 0; step < 60; ++step) {
      integrator->begin(input, state);
      limit_strain(cloth, {.strain = 0.05}, input.time_step, integrator->iterate({}), team);
      integrator->end(state);
    }
    EXPECT_FALSE(find_not_finite(state).has_value()) << name_of(options);
    // No more than a free fall of that time gives.
    EXPECT_LT(kinetic_energy(cloth, state), 0.5 * total_mass(cloth) * 2.5 * 2.5);
  }
}

TEST(Stepping, AngularMomentumErrorFallsWithTheStep) {
  // A torus that turns about its axis and breathes; linearised implicit Euler loses some turn.
  const auto lost = [](double step) {
    const Cloth cloth = torus_cloth(17, {.stretch = 50, .shear = 20, .damping = 0});
    ThreadTeam team(1);
    const StepInput input{step, {}};
    const auto integrator = make_integrator(ImplicitOptions{.tolerance = 1e-7}, cloth, input, team);
    ClothState state = rest_state(cloth);
    for (int s = 0; s < 17 * 17; ++s)
      state.velocity.set(s, cross(Vec3f{0, 3, 0}, state.position.at(s)));
    const double before = angular_momentum(cloth, state).y;
    run(*integrator, input, static_cast<int>(0.2 / step + 0.5), state);
    return 1 - angular_momentum(cloth, state).y / before;
  };
  const double coarse = lost(1.0 / 120), fine = lost(1.0 / 480);
  EXPECT_GT(coarse, 0);
  EXPECT_LT(coarse, 0.05);
  EXPECT_LT(fine, 0.35 * coarse);  // first order: a quarter
}

TEST(Stepping, HangingSheetIsTheSameAtEveryResolution) {
  const auto tip_after = [](int n) {
    Cloth cloth = sheet_cloth(n);
    pin(cloth, 0, vec_cast<double>(cloth.rest.at(0)));
    pin(cloth, n - 1, vec_cast<double>(cloth.rest.at(n - 1)));
    ThreadTeam team(1);
    const StepInput input;
    const auto integrator = make_integrator(ImplicitOptions{}, cloth, input, team);
    ClothState state = rest_state(cloth);
    run(*integrator, input, 80, state);
    return state.position.at(n - 1, n / 2);
  };
  const Vec3f middle = tip_after(33);
  EXPECT_LT(middle.y, -0.3F);
  EXPECT_LT(length(tip_after(17) - middle), 0.03F);
  EXPECT_LT(length(tip_after(65) - middle), 0.03F);
}

TEST(Stepping, OptionsThatDoNotFitNameTheirKey) {
  const Cloth cloth = sheet_cloth(17);
  ThreadTeam team(1);
  const auto message = [&](const IntegratorOptions& options) -> std::string {
    try {
      make_integrator(options, cloth, {}, team);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message(TwoLevelOptions{.local_size = 4}).find("integrator.local_size"),
            std::string::npos);
  EXPECT_NE(message(TwoLevelOptions{.local_size = 19}).find("odd number from 3 to 17"),
            std::string::npos);
  EXPECT_NE(message(TwoLevelOptions{.global_size = 7}).find("integrator.global_size"),
            std::string::npos);
  EXPECT_NE(message(TwoLevelOptions{.filter_stiffness = -1}).find("integrator.filter_stiffness"),
            std::string::npos);
  EXPECT_NE(message(ImplicitOptions{.max_iterations = 0}).find("integrator.max_iterations"),
            std::string::npos);
  EXPECT_EQ(message(TwoLevelOptions{.local_size = 17, .global_size = 9}), "");
}

}  // namespace
}  // namespace weft
