#include "weft/simulation.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "tests/sim/falling_sheet.h"
#include "tests/sim/refusals.h"
#include "weft/cloth/cloth.h"
#include "weft/cloth/wind.h"
#include "weft/collide/contacts/block_motion.h"
#include "weft/core/math.h"
#include "weft/error.h"
#include "weft/sim/stepping/adaptive_substeps.h"

namespace weft {
namespace {

using testing::free_fall;
using testing::sheet;

TEST(Simulation, FreeFallIsTheFormulaOfTheStep) {
  for (const IntegratorOptions& integrator :
       {IntegratorOptions{ImplicitOptions{}}, IntegratorOptions{ExplicitOptions{}},
        IntegratorOptions{MultigridOptions{}}}) {
    Scene scene = free_fall(integrator);
    scene.substeps = 16;
    scene.cloths[0].material.stretch = 50;  // so that the explicit method is stable
    scene.cloths[0].material.shear = 10;
    Simulation simulation(scene, "fall", 1);
    const double h = 1.0 / (60 * 16);
    for (int frame = 1; frame <= 20; ++frame) {
      const FrameReport report = simulation.advance();
      const double t = frame / 60.0;
      EXPECT_NEAR(report.centre_of_mass.x, 0.5 * t, 2e-5);
      EXPECT_NEAR(report.centre_of_mass.y, 2 + t - 9.81 * t * (t + h) / 2, 2e-5);
      EXPECT_LT(report.strain.max, 1e-4);
    }
    EXPECT_EQ(simulation.frame(), 20);
  }
}

TEST(Simulation, PinnedSamplesStayWhereTheyAreInAStorm) {
  Scene scene;
  scene.cloths = {sheet(33, {0, 1, 0})};
  scene.cloths[0].pins = {ScenePin{ImagePin{{0, 0}}, {}}, ScenePin{ImagePin{{1, 0}}, {}}};
  scene.wind = WindOptions{{0, 60, 0}, 1, 1};
  Simulation simulation(scene, "storm", 1);
  const Planes3 start = simulation.cloths()[0].state.position;
  for (int frame = 0; frame < 6; ++frame) {
    simulation.advance();
    for (const int col : {0, 32})
      ASSERT_EQ(simulation.cloths()[0].state.position.at(0, col), start.at(0, col)) << frame;
  }
}

TEST(Simulation, PlacementScalesThenRotatesThenMoves) {
  Scene scene = free_fall(ImplicitOptions{});
  scene.cloths[0].placement = {{2, 1, 1}, {0, 0, 90}, {0, 3, 0}};
  const Simulation simulation(scene, "placed", 1);
  const Planes3& rest = simulation.cloths()[0].model->rest;
  // Column 0 lies at x = -0.5: scaled to -1, turned about z onto y = -1, moved up by 3.
  EXPECT_NEAR(rest.at(0, 0).x, 0, 1e-6);
  EXPECT_NEAR(rest.at(0, 0).y, 2, 1e-6);
  EXPECT_NEAR(rest.at(0, 16).y, 4, 1e-6);
  EXPECT_NEAR(rest.at(0, 16).z, -0.5, 1e-6);
}

Scene torus_on_ground() {
  Scene scene;
  scene.cloths = {sheet(17, {0, 0.05, 0}), sheet(17, {0, 0.3, 0})};
  scene.cloths[0].name = "low";
  scene.cloths[1].name = "ring";
  scene.cloths[1].surface = "builtin:torus";
  return scene;
}

TEST(Simulation, AnyNumberOfThreadsGivesTheSameHash) {
  for (const IntegratorOptions& integrator :
       {IntegratorOptions{ImplicitOptions{}}, IntegratorOptions{TwoLevelOptions{.local_size = 5}},
        IntegratorOptions{MultigridOptions{}}, IntegratorOptions{DesbrunOptions{}}}) {
    Scene scene = torus_on_ground();
    scene.integrator = integrator;
    const auto hash = [&](int threads) {
      Simulation simulation(scene, "hash", threads);
      for (int frame = 0; frame < 5; ++frame) simulation.advance();
      return simulation.state_hash();
    };
    const std::string one = hash(1);
    EXPECT_EQ(one.size(), 16);
    EXPECT_EQ(hash(2), one);
    EXPECT_EQ(hash(3), one);
  }
}

TEST(Simulation, FrictionStopsASlidingSheet) {
  Scene scene;
  scene.cloths = {sheet(17, {0, 0.006, 0})};
  scene.cloths[0].velocity = {0.5, 0, 0};
  scene.cloths[0].friction = 0.5;
  Simulation simulation(scene, "slide", 1);
  FrameReport report;
  for (int frame = 0; frame < 30; ++frame) report = simulation.advance();
  // mu = 0.5 against the ground's 0.5: it stops after v^2 / (2 mu g) = 2.5 cm.
  EXPECT_NEAR(report.centre_of_mass.x, 0.0255, 0.004);
  EXPECT_LT(report.kinetic_energy, 1e-6);
  EXPECT_EQ(report.contacts, 17 * 17);
}

/// A sheet on an inclined plane, as gravity turned by an angle; mu = 0.5. @return how far it slid
/// in half a second
double slide_down(double degrees) {
  Scene scene;
  const double angle = degrees * pi / 180;
  scene.gravity = {9.81 * sine(angle), -9.81 * cosine(angle), 0};
  scene.cloths = {sheet(17, {0, 0.006, 0})};  // the gap that is kept: three thicknesses
  scene.cloths[0].friction = 0.5;
  Simulation simulation(scene, "incline", 1);
  for (int frame = 0; frame < 30; ++frame) simulation.advance();
  return simulation.centre_of_mass().x;
}

TEST(Simulation, SheetSticksToAGentleInclineAndSlidesDownASteepOne) {
  EXPECT_NEAR(slide_down(25), 0, 2e-4);
  const double angle = 32 * pi / 180, acceleration = 9.81 * (sine(angle) - 0.5 * cosine(angle));
  const double distance = 0.5 * acceleration * 0.5 * (0.5 + 1.0 / 240);
  EXPECT_NEAR(slide_down(32), distance, 0.02 * distance);
}

TEST(Simulation, NoParticleEndsUnderTheGround) {
  Scene scene = torus_on_ground();
  Simulation simulation(scene, "ground", 1);
  for (int frame = 0; frame < 30; ++frame)
    // Of the 2 mm that are kept, an impact at metres a second leaves little for a while.
    EXPECT_GT(simulation.advance().smallest_gap, 0);
}

TEST(Simulation, LimiterCarriesTheSoftSpringsOfTwoLevel) {
  Scene scene = free_fall(TwoLevelOptions{});
  scene.cloths[0] = sheet(65, {0, 2, 0});
  scene.cloths[0].material = weft::testing::soft_fabric;
  scene.cloths[0].pins = {ScenePin{ImagePin{{0, 0}}, {}}, ScenePin{ImagePin{{1, 0}}, {}}};
  Simulation simulation(scene, "hang", 2);
  FrameReport report;
  for (int frame = 0; frame < 30; ++frame) report = simulation.advance();
  // Single-spring passes alone let it stretch to more than twice its length. Its diagonals give
  // way: the upper side, 5 % longer than its chord, sags by 0.13 m.
  EXPECT_NEAR(report.centre_of_mass.y, 2 - 0.59, 0.03);
  EXPECT_LT(report.strain.p99, 0.08);
  EXPECT_LT(report.strain.max, 0.25);
}

/// Of a sheet that hangs by two corners and would be limited.
std::string hash_of_hanging(const IntegratorOptions& integrator, std::optional<int> passes,
                            double strain_limit = 0.001) {
  Scene scene = free_fall(integrator);
  scene.limiter_passes = passes;
  scene.cloths[0].velocity = {};
  scene.cloths[0].material = {.stretch = 20, .shear = 2, .strain_limit = strain_limit};
  scene.cloths[0].pins = {ScenePin{ImagePin{{0, 0}}, {}}, ScenePin{ImagePin{{1, 0}}, {}}};
  Simulation simulation(scene, "hang", 1);
  for (int frame = 0; frame < 10; ++frame) simulation.advance();
  return simulation.state_hash();
}

TEST(Simulation, LimiterIsThereWhereTheMethodHasOneOrIsToldTo) {
  const IntegratorOptions explicit_euler = ExplicitOptions{};
  EXPECT_EQ(hash_of_hanging(explicit_euler, {}), hash_of_hanging(explicit_euler, 0));
  EXPECT_NE(hash_of_hanging(explicit_euler, {}), hash_of_hanging(explicit_euler, 60));
  for (const IntegratorOptions& options :
       {IntegratorOptions(MultigridOptions{}), IntegratorOptions(DesbrunOptions{})}) {
    EXPECT_EQ(hash_of_hanging(options, {}), hash_of_hanging(options, 60)) << name_of(options);
    EXPECT_NE(hash_of_hanging(options, {}), hash_of_hanging(options, 0)) << name_of(options);
    EXPECT_EQ(hash_of_hanging(options, {}, 0), hash_of_hanging(options, 0, 0)) << name_of(options);
  }
  // What implicit Euler solves for needs none, whatever is asked for.
  EXPECT_EQ(hash_of_hanging(ImplicitOptions{}, {}), hash_of_hanging(ImplicitOptions{}, 60));
}

TEST(Simulation, TwoLevelLimitsAtFivePercentWhereTheMaterialSaysNothing) {
  const IntegratorOptions options = TwoLevelOptions{.local_size = 5};
  EXPECT_EQ(hash_of_hanging(options, {}, 0), hash_of_hanging(options, {}, 0.05));
  EXPECT_NE(hash_of_hanging(options, {}, 0), hash_of_hanging(options, {}, 0.06));
  EXPECT_NE(hash_of_hanging(options, {}, 0), hash_of_hanging(options, 0, 0));
}

TEST(Simulation, PinsHold) {
  Scene scene = free_fall(ImplicitOptions{});
  scene.cloths[0].velocity = {};
  scene.cloths[0].pins = {ImagePin{{0, 0}}, NearestPin{{0.5, 2, -0.5}}};
  Simulation simulation(scene, "pins", 1);
  for (int frame = 0; frame < 10; ++frame) simulation.advance();
  const ClothState& state = simulation.cloths()[0].state;
  EXPECT_EQ(state.position.at(0, 0), (Vec3f{-0.5F, 2, -0.5F}));
  EXPECT_EQ(state.position.at(0, 16), (Vec3f{0.5F, 2, -0.5F}));
  EXPECT_LT(state.position.at(16, 8).y, 1.9F);
}

TEST(Simulation, PinsFollowTheirPaths) {
  Scene scene = free_fall(ImplicitOptions{});
  scene.cloths[0].velocity = {};
  // One side turns by a quarter about its middle while it rises, then rests.
  scene.cloths[0].pins = {
      ScenePin(RegionPin{{0, 0}, {1, 0}}, {{0.1, {}, {}}, {0.3, {0, 90, 0}, {0, 0.2, 0}}})};
  Simulation simulation(scene, "pins", 1);
  const auto corner = [&] { return simulation.cloths()[0].state.position.at(0, 16); };
  for (int frame = 0; frame < 6; ++frame) simulation.advance();
  EXPECT_EQ(corner(), (Vec3f{0.5F, 2, -0.5F}));
  for (int frame = 6; frame < 12; ++frame) simulation.advance();
  const float half = 0.5F * std::sqrt(0.5F);
  EXPECT_LT(length(corner() - Vec3f{half, 2.1F, -0.5F - half}), 1e-6F);
  for (int frame = 12; frame < 20; ++frame) simulation.advance();
  EXPECT_LT(length(corner() - Vec3f{0, 2.2F, -1}), 1e-6F);
  EXPECT_LT(length(simulation.cloths()[0].state.velocity.at(0, 16)), 1e-4F);
}

TEST(Simulation, LaterPinTakesASampleFromAPath) {
  Scene scene = free_fall(ImplicitOptions{});
  scene.cloths[0].self_collision = false;  // the others are drawn across the one that stays
  scene.cloths[0].pins = {ScenePin(RegionPin{{0, 0}, {1, 0}}, {{0, {}, {}}, {0.1, {}, {1, 0, 0}}}),
                          ImagePin{{1, 0}}};
  Simulation simulation(scene, "pins", 1);
  simulation.advance();
  EXPECT_EQ(simulation.cloths()[0].state.position.at(0, 16), (Vec3f{0.5F, 2, -0.5F}));
  EXPECT_GT(simulation.cloths()[0].state.position.at(0, 0).x, -0.5F);
}

TEST(Simulation, WindCarriesCloth) {
  for (const IntegratorOptions& integrator :
       {IntegratorOptions{ImplicitOptions{}}, IntegratorOptions{MultigridOptions{}}}) {
    Scene scene = free_fall(integrator);
    scene.gravity = {};
    scene.cloths[0].velocity = {};
    scene.wind = WindOptions{{0, 3, 0}, 1, 1};
    Simulation simulation(scene, "wind", 1);
    Vec3d centre;
    for (int frame = 0; frame < 30; ++frame) centre = simulation.advance().centre_of_mass;
    // A plate face on: dv/dt = k (w - v)^2, so v = w - w / (1 + k w t).
    const double k = 0.5 * air_density / 0.2, t = 0.5;
    const double distance = 3 * t - std::log(1 + k * 3 * t) / k;
    EXPECT_NEAR(centre.y - 2, distance, 0.02 * distance);
  }
}

TEST(Simulation, AirDampingSlowsFallingClothAndIsNoGain) {
  Scene scene = free_fall(NewtonOptions{});
  scene.cloths[0].velocity = {};
  scene.air_damping = 3;
  Simulation simulation(scene, "air", 1);
  const double h = 1.0 / (60 * 4), kept = 1 / (1 + 3 * h);
  double speed = 0, fallen = 0, work = 0;
  FrameReport report;
  for (int frame = 0; frame < 60; ++frame) {
    report = simulation.advance();
    work += report.work;
    for (int step = 0; step < 4; ++step) {
      speed = kept * speed + 9.81 * h;
      fallen += h * speed;
    }
    ASSERT_NEAR(report.centre_of_mass.y, 2 - fallen, 2e-4) << frame;
  }
  // Weight lets the centre fall; what did not become motion the air took.
  const double mass = report.kinetic_energy / (speed * speed / 2);
  EXPECT_NEAR(work, report.kinetic_energy - mass * 9.81 * fallen, 0.02 * mass * 9.81 * fallen);
}

TEST(Simulation, AirDampingLeavesPinsThatMoveTheirWay) {
  Scene scene;
  scene.cloths = {sheet(17, {0, 1, 0})};
  scene.cloths[0].pins = {ScenePin{ImagePin{{0, 0}}, {{0, {}, {}}, {1, {}, {0.5, 0, 0}}}}};
  scene.air_damping = 20;
  Simulation simulation(scene, "air", 1);
  const Vec3f start = simulation.cloths()[0].state.position.at(0, 0);
  for (int frame = 0; frame < 30; ++frame) simulation.advance();
  const Vec3f end = simulation.cloths()[0].state.position.at(0, 0);
  EXPECT_NEAR(end.x - start.x, 0.25, 1e-5);
  EXPECT_EQ(end.y, start.y);
}

TEST(Simulation, AttachedClothGoesWithItsBody) {
  Scene scene;
  scene.ground.reset();
  scene.gravity = {};
  scene.cloths = {sheet(9, {0, 1, 0})};
  scene.cloths[0].attach = {{"rod", RegionPin{{0, 0}, {1, 0}}}};
  SceneBody rod;
  rod.name = "rod";
  rod.surface = "builtin:cylinder";
  rod.size = 17;
  rod.placement = {{0.1, 1, 0.1}, {0, 0, 90}, {0, 1.05, -0.5}};
  rod.motion = {{0, {}, {}}, {0.1, {}, {0, 0.3, 0}}};
  scene.bodies = {rod};
  Simulation simulation(scene, "tied", 1);
  const ClothState before = simulation.cloths()[0].state;
  for (int frame = 0; frame < 6; ++frame) simulation.advance();
  const ClothState& after = simulation.cloths()[0].state;
  for (int c = 0; c < 9; ++c) {
    EXPECT_NEAR(after.position.y(0, c), before.position.y(0, c) + 0.3, 1e-5);
    EXPECT_NEAR(after.position.x(0, c), before.position.x(0, c), 1e-5);
  }
  EXPECT_NEAR(simulation.bodies()[0].positions.at(3, 3).y, 1.35, 0.03);
}

/// Keeps the farthest way of a body in any step.
class FarthestBodyStep final : public StepWatcher {
 public:
  void see(const StepMotion& step) override {
    for (const StepMotion::Path& body : step.bodies)
      farthest = std::max(farthest, largest_displacement(*body.start, *body.end));
  }
  double farthest = 0;  ///< [m]
};

/// The ball starts late in a substep of 8.3 ms, with 20 m/s: over all of it that is 2 m/s.
TEST(Simulation, ABodyThatStartsWithinASubstepGoesNoFartherInAStepThanOthers) {
  Scene scene;
  scene.ground.reset();
  scene.gravity = {};
  scene.substeps = 2;
  scene.cloths = {sheet(17, {0, 0.102, 0})};
  SceneBody ball;
  ball.name = "ball";
  ball.surface = "builtin:sphere";
  ball.size = 17;
  ball.placement.scale = {0.2, 0.2, 0.2};
  ball.motion = {{0, {}, {}}, {0.0075, {}, {}}, {0.1075, {}, {0, 2, 0}}};
  scene.bodies = {ball};
  Simulation simulation(scene, "struck", 1);
  FarthestBodyStep watcher;
  simulation.watch(&watcher);
  simulation.advance();
  const double gap = 3 * simulation.cloths()[0].model->material.thickness;
  const double gaps =
      std::max(ApproachRule::min_gaps, ApproachRule::max_gaps * ApproachRule::calm_speed / 20);
  const double most = 1.5 * gaps * gap;
  EXPECT_GT(watcher.farthest, most / 4);
  EXPECT_LT(watcher.farthest, most);
}

TEST(Simulation, RegionWithoutSamplesIsRefused) {
  Scene scene = free_fall(ImplicitOptions{});
  scene.cloths[0].pins = {RegionPin{{0.01, 0.01}, {0.02, 0.02}}};
  EXPECT_THROW(Simulation(scene, "pins", 1), SceneError);
}

TEST(Simulation, MethodsThatSuitNoClothOfThatSizeNameTheSceneAndTheCloth) {
  Scene scene = free_fall(TwoLevelOptions{.global_size = 7});
  scene.cloths[0].name = "flag";
  const std::string told = test::refusal_of(scene);
  EXPECT_TRUE(told.starts_with("s.json: 'flag': integrator.global_size: 7; ")) << told;
}

}  // namespace
}  // namespace weft
