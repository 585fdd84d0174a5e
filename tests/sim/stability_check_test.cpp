#include "weft/sim/stepping/stability_check.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "tests/sim/falling_sheet.h"
#include "tests/sim/made_up_step.h"
#include "tests/support/errors.h"
#include "weft/error.h"
#include "weft/simulation.h"

namespace weft {
namespace {

using testing::free_fall;
using testing::MadeUpStep;
using testing::sheet;

/// Whether a frame is stopped that ends with so much energy more than the run began with.
bool stops(MadeUpStep& step, double more, double p99) {
  const std::string name = "made up";
  StabilityCheck check(name, step.cloths(), step.movers());
  FrameReport report;
  report.kinetic_energy = step.total() + more;
  report.strain.p99 = p99;
  try {
    check.check_energy({}, report, report.kinetic_energy, false, step.budget);
  } catch (const Unstable&) {
    return true;
  }
  return false;
}

/// What a run of 60 frames ends with; empty where it did not run away.
std::string runaway_of(const Scene& scene) {
  return test::message_of<SceneError>([&] {
    Simulation simulation(scene, "scene.json", 1);
    for (int frame = 0; frame < 60; ++frame) simulation.advance();
  });
}

TEST(StabilityCheck, StopsFarStretchedClothInOneFrameWhoseEnergyNoForceExplains) {
  MadeUpStep step;
  EXPECT_FALSE(stops(step, 0, 1.5)) << "soft cloth";
  EXPECT_TRUE(stops(step, 20, 1.5));
  EXPECT_FALSE(stops(step, 20, 0.5)) << "one frame does not tell";
  step.budget.add_pulled(20);
  EXPECT_TRUE(stops(step, 20, 1.5)) << "the filter's work explains nothing";
  step.budget.finish_step(20, true);
  EXPECT_FALSE(stops(step, 20, 1.5)) << "stretched by work";
}

/// What is said of two frames that end with so much energy more than the run began with.
std::string said_of_two(MadeUpStep& step, double more, const StabilityCheck::Now& now = {}) {
  const std::string name = "made up";
  StabilityCheck check(name, step.cloths(), step.movers());
  FrameReport report;
  report.kinetic_energy = step.total() + more;
  return test::message_of<Unstable>([&] {
    for (int i = 0; i < 2; ++i)
      check.check_energy(now, report, report.kinetic_energy, false, step.budget);
  });
}

bool stops_in_two(MadeUpStep& step, double more) { return !said_of_two(step, more).empty(); }

TEST(StabilityCheck, WantsOtherStartsOfClothThatIsTakenApart) {
  MadeUpStep step;
  StabilityCheck::Now now;
  EXPECT_NE(said_of_two(step, 20, now).find("more substeps"), std::string::npos);
  now.crossings = 1;
  EXPECT_NE(said_of_two(step, 20, now).find("cloths that begin apart"), std::string::npos);
}

TEST(StabilityCheck, LetsHeavyClothGainWhatContactsMayLend) {
  MadeUpStep step(1000);
  const double lent = step.budget.max_lent();
  const double explained = 0.05 * step.budget.at_start().own();
  ASSERT_GT(1.9 * lent, 1.1 * explained);
  EXPECT_FALSE(stops_in_two(step, 1.9 * lent));
  EXPECT_TRUE(stops_in_two(step, 2.1 * lent));
}

TEST(StabilityCheck, GoesOnAfterAFrameThatARestoredStateCounted) {
  MadeUpStep step;
  const std::string name = "made up";
  FrameReport report;
  report.kinetic_energy = step.total() + 20;
  const auto look = [&](StabilityCheck& check) {
    check.check_energy({}, report, report.kinetic_energy, false, step.budget);
  };
  StabilityCheck before(name, step.cloths(), step.movers());
  look(before);
  EXPECT_EQ(before.frames_beyond(), 1);
  StabilityCheck resumed(name, step.cloths(), step.movers());
  resumed.restore(before.frames_beyond());
  EXPECT_THROW(look(resumed), Unstable);
}

TEST(StabilityCheck, InstabilityThatTheLimiterTamesIsStillFound) {
  // At this step explicit Euler shakes the sheet to pieces of twice their size, slowly.
  Scene scene = free_fall(ExplicitOptions{});
  scene.limiter_passes = 60;
  scene.cloths[0].material.stretch = 20000;
  scene.cloths[0].material.strain_limit = 0.05;
  scene.cloths[0].self_collision = false;
  Simulation simulation(scene, "shake", 1);
  EXPECT_THROW(
      {
        for (int frame = 0; frame < 30; ++frame) simulation.advance();
      },
      SceneError);
}

TEST(StabilityCheck, InstabilityNamesFrameClothParticleAndTheStableStep) {
  Scene scene = free_fall(ExplicitOptions{});
  scene.cloths[0].name = "stiff";
  scene.cloths[0].material.stretch = 1e6;
  scene.cloths[0].material.strain_limit = 0;
  scene.cloths[0].pins = {ImagePin{{0, 0}}};
  const std::string text = runaway_of(scene);
  EXPECT_NE(text.find("scene.json: cloth 'stiff' ran away at frame "), std::string::npos) << text;
  EXPECT_NE(text.find("particle (row "), std::string::npos) << text;
  EXPECT_NE(text.find("), which moves at "), std::string::npos) << text;
  EXPECT_NE(text.find("largest stable step"), std::string::npos) << text;
}

TEST(StabilityCheck, SoftClothMayStretchToTwiceItsLengthAndMore) {
  Scene scene;
  scene.ground.reset();
  scene.cloths = {sheet(17, {0, 2, 0})};
  scene.cloths[0].material = {.density = 0.5, .stretch = 2, .shear = 1};
  scene.cloths[0].pins = {ImagePin{{0, 0}}, ImagePin{{0, 1}}};
  Simulation simulation(scene, "rubber", 1);
  double most = 0;
  for (int frame = 0; frame < 40; ++frame) {
    const FrameReport report = simulation.advance();
    most = std::max(most, report.strain.p99);
    EXPECT_LT(report.kinetic_energy + report.potential_energy, 0.5 * 9.81 * 2.01);
  }
  EXPECT_GT(most, 1);
}

TEST(StabilityCheck, RunawayFilterNamesTheStableStiffness) {
  Scene scene = free_fall(TwoLevelOptions{.local_size = 5, .filter_stiffness = 1000});
  scene.limiter_passes = 0;
  scene.cloths[0].pins = {ImagePin{{0, 0}}};
  const std::string text = runaway_of(scene);
  EXPECT_NE(text.find("ran away at frame "), std::string::npos) << text;
  EXPECT_NE(text.find("the largest stiffness known to be stable"), std::string::npos) << text;
  EXPECT_NE(text.find("filter_stiffness is 1e+03 N/m"), std::string::npos) << text;
}

TEST(StabilityCheck, StiffFiltersAreCautionedAgainst) {
  Scene scene = free_fall(TwoLevelOptions{.local_size = 5, .filter_stiffness = 0.1});
  scene.cloths[0].material.bending = 0;
  EXPECT_TRUE(Simulation(scene, "soft", 1).notes().empty());
  scene.integrator = TwoLevelOptions{.local_size = 5, .filter_stiffness = 1000};
  const Simulation stiff(scene, "stiff", 1);
  ASSERT_EQ(stiff.notes().size(), 1U);
  EXPECT_NE(stiff.notes()[0].find("largest stiffness known to be stable"), std::string::npos);
  scene.integrator = DesbrunOptions{};
  scene.cloths[0].material.bending = 1e-5;
  EXPECT_NE(Simulation(scene, "bends", 1).notes().at(0).find("bending"), std::string::npos);
}

TEST(StabilityCheck, ExplicitStepsBeyondTheLargestStableAreCautionedAgainst) {
  Scene scene = free_fall(ExplicitOptions{});
  scene.substeps = 100;
  EXPECT_TRUE(Simulation(scene, "small steps", 1).notes().empty());
  scene.substeps = 5;
  EXPECT_NE(Simulation(scene, "large steps", 1).notes().at(0).find("the largest stable step"),
            std::string::npos);
}

TEST(StabilityCheck, FastBodiesAreNoRunaway) {
  Scene scene;
  scene.ground.reset();
  scene.gravity = {};
  scene.cloths = {sheet(9, {0, 1, 0})};
  scene.cloths[0].attach = {{"ball", ImagePin{{0.5, 0.5}}}};
  SceneBody ball;
  ball.name = "ball";
  ball.surface = "builtin:torus";
  ball.size = 17;
  ball.placement.scale = {0.1, 0.1, 0.1};
  ball.motion = {{0, {}, {}}, {0.2, {}, {4, 0, 0}}};
  scene.bodies = {ball};
  Simulation simulation(scene, "fast", 1);
  for (int frame = 0; frame < 12; ++frame) ASSERT_NO_THROW(simulation.advance());
  EXPECT_GT(simulation.centre_of_mass().x, 3);
}

}  // namespace
}  // namespace weft
