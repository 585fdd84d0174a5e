// Steps that collide: what they may gain, how they are refused, and that this is nowhere seen.
#include <algorithm>

#include <gtest/gtest.h>

#include "weft/core/math.h"
#include "weft/fabric.h"
#include "weft/run.h"
#include "weft/scene_file.h"
#include "weft/simulation.h"

namespace weft {
namespace {

SceneCloth sheet(int size, Vec3d translate) {
  SceneCloth cloth;
  cloth.size = size;
  cloth.placement.translate = translate;
  cloth.self_collision = true;
  return cloth;
}

/// A sheet whose one edge is pulled over the rest of it, no gravity.
Scene pulled_sheet() {
  Scene scene;
  scene.ground.reset();
  scene.gravity = {};
  scene.cloths = {sheet(33, {0, 0.6, 0})};
  scene.cloths[0].pins = {
      ScenePin{RegionPin{{1, 0}, {1, 1}}, {{0.1, {}, {}}, {0.5, {}, {2.5, 0, 0}}}}};
  return scene;
}

/// A sheet that is set down on the ground nearly edge-on.
Scene set_down() {
  Scene scene;
  scene.ground = 0;
  scene.cloths = {sheet(33, {0, 0.6, 0})};
  scene.cloths[0].placement.rotate = {88, 0, 0};
  scene.cloths[0].velocity = {0, -5, 0};
  return scene;
}

/// Runs a number of frames. @return their reports
std::vector<FrameReport> run(Simulation& simulation, int frames) {
  std::vector<FrameReport> reports;
  for (int frame = 0; frame < frames; ++frame) reports.push_back(simulation.advance());
  return reports;
}

double gained(const Simulation& simulation, const std::vector<FrameReport>& reports) {
  RunReport report;
  report.start_energy = simulation.start_energy();
  report.history = reports;
  return energy_gained(report);
}

TEST(StepEnergy, APulledSheetExpandsAgainOnceThePullEnds) {
  Simulation simulation(pulled_sheet(), "pulled", 1);
  const std::vector<FrameReport> reports = run(simulation, 60);
  for (const FrameReport& report : reports) EXPECT_LT(report.strain.p99, 0.1);
  // Half a second after the pin stopped.
  EXPECT_LT(reports.back().strain.p99, 0.02);
  EXPECT_LT(reports.back().strain.max, 0.05);
}

TEST(StepEnergy, AThrownSheetGainsNone) {
  Simulation simulation(set_down(), "set down", 1);
  const std::vector<FrameReport> reports = run(simulation, 30);
  const double max = 0.01 * simulation.mass() * 9.81;
  EXPECT_LT(gained(simulation, reports), max);
  int stopped = 0;
  for (const FrameReport& report : reports) stopped = std::max(stopped, report.stopped);
  EXPECT_GT(stopped, 0);
}

TEST(StepEnergy, WorkOfPinsAccountsForWhatTheyPutIn) {
  Simulation simulation(pulled_sheet(), "pulled", 1);
  const std::vector<FrameReport> reports = run(simulation, 40);
  double work = 0, max = 0;
  for (const FrameReport& report : reports) {
    work += report.work;
    max = std::max(max, report.kinetic_energy + report.potential_energy);
  }
  // Brought to 6 m/s and more, it carries a good part of what was done on it.
  EXPECT_GT(max, 0.3 * work);
  EXPECT_LT(gained(simulation, reports), 0.05 * work);
}

/// A closed cloth hung by one sample, over which a cone goes: it takes the sample along.
constexpr const char* overrun = R"({
  "version": 1, "ground": 0,
  "cloths": [ { "surface": "builtin:cylinder", "size": 17, "scale": 0.5, "rotate": [-96.69, -65.75, 2.79],
                "translate": [0, 1, 0], "material": "linen", "pins": [ { "image": [0, 0] } ] } ],
  "bodies": [ { "surface": "builtin:cone", "size": 33, "scale": 0.44, "rotate": [102.77, -104.56, -51.46],
                "translate": [0.5, 1.02, -0.75],
                "motion": [ { "time": 0.05 }, { "time": 0.49, "translate": [-1.02, 0, 1.49] } ] } ] })";

/// Where the pin went back at once, the cloth was flung away at 20 km/s; where a body's pressure on
/// the pin itself counted as the pin's work, 6 J were gained.
TEST(StepEnergy, APinThatABodyTakesAlongGoesBackAndGainsNone) {
  Simulation simulation(parse_scene(overrun, "overrun", ""), "overrun", 1);
  const auto pinned = [&] { return simulation.cloths()[0].state.position.at(0, 0); };
  const Vec3f place = pinned();
  std::vector<FrameReport> reports;
  float farthest = 0;
  double put_in = 0;
  for (int frame = 0; frame < 30; ++frame) {
    reports.push_back(simulation.advance());
    put_in += reports.back().work;
    farthest = std::max(farthest, length(pinned() - place));
  }
  EXPECT_GT(farthest, 0.02F);
  EXPECT_EQ(pinned(), place);
  EXPECT_LT(gained(simulation, reports), 0.02 * put_in);
}

/// Closer than their thickness, which the contacts want back at once: in steps however short.
TEST(StepEnergy, LayersThatBeginTooCloseTogetherPartGently) {
  Scene scene;
  scene.ground.reset();
  scene.cloths = {sheet(33, {0, 0, 0}), sheet(33, {0, 1e-4, 0})};
  scene.cloths[1].name = "upper";
  Simulation simulation(scene, "close", 1);
  const std::vector<FrameReport> reports = run(simulation, 10);
  EXPECT_LT(gained(simulation, reports), 0.01 * simulation.mass() * standard_gravity);
  EXPECT_GT(reports.front().self_contacts, 0);
}

/// The pins of a hanging sheet start to move down at once, and the sheet falls behind them.
TEST(StepEnergy, WorkOfPinsThatStartSuddenlyIsTheirs) {
  Scene scene;
  scene.ground.reset();
  scene.cloths = {sheet(65, {0, 2, 0})};
  scene.cloths[0].placement.rotate = {-90, 0, 0};
  scene.cloths[0].pins = {
      ScenePin{RegionPin{{0, 1}, {1, 1}}, {{0.05, {}, {}}, {3.05, {}, {0, -1.2, 0}}}}};
  Simulation simulation(scene, "lowered", 1);
  const std::vector<FrameReport> reports = run(simulation, 20);
  double work = 0;
  for (const FrameReport& report : reports) work += report.work;
  const double weight = simulation.mass() * standard_gravity;
  EXPECT_LT(gained(simulation, reports), 1e-3 * weight);
  // Lowered at 0.4 m/s for 17 frames, less what it takes to get it going.
  EXPECT_NEAR(work, -0.4 * (17.0 / 60 * weight - 0.4 * simulation.mass()), 0.03 * weight * 0.4);
}

/// A tube that falls onto itself and the ground while a pin pulls one corner away.
Scene tube_on_a_pin() {
  Scene scene;
  scene.substeps = 2;
  scene.cloths = {sheet(33, {})};
  scene.cloths[0].surface = "builtin:cylinder";
  scene.cloths[0].placement.rotate = {-69, 167, 44};
  scene.cloths[0].material = find_material("silk").value();
  scene.cloths[0].pins = {ScenePin{ImagePin{{0, 1}}, {{0, {}, {}}, {0.5, {}, {-0.4, 0.5, 0.3}}}}};
  return scene;
}

TEST(StepEnergy, WorkOfAPinIsKnownWhereClothTouchesItselfAndTheGround) {
  Simulation simulation(tube_on_a_pin(), "tube", 1);
  const std::vector<FrameReport> reports = run(simulation, 15);
  int touching = 0;
  for (const FrameReport& report : reports)
    touching += report.self_contacts > 0 && report.contacts > 0;
  EXPECT_GT(touching, 3);
  EXPECT_LT(gained(simulation, reports), 0.003 * simulation.mass() * standard_gravity);
}

/// What pins are said to do, and the limiter by which they pull a sheet along, against what it
/// gains.
TEST(StepEnergy, PullOfALimiterCountsOnce) {
  Scene scene;
  scene.ground.reset();
  scene.gravity = {};
  scene.integrator = MultigridOptions{};
  scene.cloths = {sheet(33, {})};
  scene.cloths[0].self_collision = false;
  scene.cloths[0].material.stretch = {200, 200};
  scene.cloths[0].material.strain_limit = 0.01;
  scene.cloths[0].pins = {ScenePin{RegionPin{{1, 0}, {1, 1}}, {{0, {}, {}}, {1, {}, {1, 0, 0}}}}};
  Simulation simulation(scene, "pulled", 1);
  const std::vector<FrameReport> reports = run(simulation, 20);
  SimulationState state;
  simulation.save(state);
  const FrameReport& last = reports.back();
  const double energy = last.kinetic_energy + last.potential_energy - simulation.start_energy();
  EXPECT_GT(state.work.pulled, 0.1 * energy);
  EXPECT_NEAR(state.work.net + state.work.pulled, energy, 0.25 * energy);
}

/// Soft springs that a limit holds, which carry more than all others.
TEST(StepEnergy, WhatAStrainLimitHoldsIsEnergyToo) {
  Scene scene;
  scene.ground.reset();
  scene.cloths = {sheet(33, {0, 2, 0})};
  scene.cloths[0].material.stretch = {20, 20};
  scene.cloths[0].material.shear = 20;
  scene.cloths[0].material.strain_limit = 0.05;
  scene.cloths[0].pins = {ScenePin{RegionPin{{0, 0}, {1, 0}}, {}}};
  Simulation simulation(scene, "limited", 1);
  const std::vector<FrameReport> reports = run(simulation, 60);
  double strain = 0;
  for (const FrameReport& report : reports) strain = std::max(strain, report.strain.p99);
  EXPECT_GT(strain, 0.06);
  EXPECT_LT(gained(simulation, reports), 5e-5 * simulation.mass() * standard_gravity);
}

/// A sheet that lies on a box and is pulled off it, this far in 0.15 s [m].
Scene tablecloth(double far) {
  Scene scene;
  scene.cloths = {sheet(33, {0, 0.61, 0})};
  scene.cloths[0].friction = 0.3;
  scene.cloths[0].pins = {
      ScenePin{RegionPin{{1, 0}, {1, 1}}, {{0.1, {}, {}}, {0.25, {}, {far, 0, 0}}}}};
  SceneBody table;
  table.surface = "builtin:box";
  table.size = 33;
  table.placement.scale = {1.2, 0.1, 1.4};
  table.placement.translate = {0, 0.58, 0};
  table.friction = 0.3;
  scene.bodies = {table};
  return scene;
}

TEST(StepEnergy, ASheetPulledOffATableStrainsLittleAndGainsNone) {
  int gains = 0;
  for (const double far : {1.6, 1.7, 1.8, 1.9, 2.0}) {
    Simulation simulation(tablecloth(far), "tablecloth", 1);
    const std::vector<FrameReport> reports = run(simulation, 20);
    for (const FrameReport& report : reports) EXPECT_LT(report.strain.p99, 0.05);
    SimulationState state;
    simulation.save(state);
    EXPECT_LT(gained(simulation, reports), 0.002 * state.work.gross);
    gains += gained(simulation, reports) > 1e-3 * simulation.mass() * 9.81 ? 1 : 0;
  }
  EXPECT_LE(gains, 1);
}

/// Two sheets on each other that a ball lifts: the upper one is touched by the lower alone.
Scene lifted_layers() {
  Scene scene;
  scene.ground.reset();
  scene.gravity = {};
  scene.cloths = {sheet(17, {0, 0.3, 0}), sheet(17, {0, 0.303, 0})};
  for (std::size_t i = 0; i < 2; ++i) scene.cloths[i].name = i == 0 ? "lower" : "upper";
  SceneBody ball;
  ball.surface = "builtin:sphere";
  ball.size = 33;
  ball.placement.scale = {0.4, 0.4, 0.4};
  ball.placement.translate = {0, 0.09, 0};
  ball.motion = {{0, {}, {}}, {0.5, {}, {0, 1, 0}}};
  scene.bodies = {ball};
  return scene;
}

TEST(StepEnergy, WorkOfABodyReachesTheLayerAbove) {
  Simulation simulation(lifted_layers(), "lifted", 1);
  const std::vector<FrameReport> reports = run(simulation, 20);
  double work = 0;
  for (const FrameReport& report : reports) work += report.work;
  EXPECT_GT(reports.back().kinetic_energy, 0.2 * work);
  EXPECT_LT(gained(simulation, reports), 0.05 * work);
}

/// A shirt on a figure that is moved to and fro.
Scene carried_shirt() {
  Scene scene;
  SceneCloth shirt = sheet(33, {});
  shirt.surface = "builtin:tshirt";
  scene.cloths = {shirt};
  SceneBody figure;
  figure.surface = "builtin:mannequin";
  figure.size = 33;
  figure.motion = {{0, {}, {}}, {0.2, {}, {0.2, 0.1, 0}}, {0.4, {}, {}}, {0.5, {}, {0, -0.1, 0.2}}};
  scene.bodies = {figure};
  return scene;
}

/// What a solve leaves on particles goes along with the figure as they do.
TEST(StepEnergy, AShirtThatIsCarriedToAndFroGainsNone) {
  Simulation simulation(carried_shirt(), "carried", 1);
  const std::vector<FrameReport> reports = run(simulation, 40);
  EXPECT_LT(gained(simulation, reports), 2e-4 * simulation.mass() * 9.81);
}

/// A towel of which both ends are turned, against each other, until it lies on itself.
Scene twisted_towel() {
  Scene scene;
  scene.ground.reset();
  scene.gravity = {};
  scene.substeps = 8;
  scene.cloths = {sheet(33, {})};
  scene.cloths[0].material = find_material("cotton").value();
  scene.cloths[0].placement.scale = {1, 1, 0.3};
  for (const double end : {0.0, 1.0})
    scene.cloths[0].pins.push_back(ScenePin{
        RegionPin{{end, 0}, {end, 1}},
        {{0, {}, {}}, {3.5, {end > 0 ? 900.0 : -900.0, 0, 0}, {end > 0 ? -0.25 : 0.25, 0, 0}}}});
  return scene;
}

/// Parts that press on each other are nearest to pins that go different ways.
TEST(StepEnergy, ATowelTwistedOntoItselfGainsLittle) {
  Simulation simulation(twisted_towel(), "twisted", 1);
  const std::vector<FrameReport> reports = run(simulation, 40);
  EXPECT_GT(reports.back().self_contacts, 100);
  EXPECT_LT(gained(simulation, reports), 8e-3 * simulation.mass() * 9.81);
}

/// A sheet that is set down onto a ball that rises.
Scene set_down_on_ball() {
  Scene scene = set_down();
  SceneBody ball;
  ball.surface = "builtin:sphere";
  ball.size = 33;
  ball.placement.scale = {0.2, 0.2, 0.2};
  ball.placement.translate = {0.1, 0.05, 0};
  ball.motion = {{0, {}, {}}, {2, {0, 90, 0}, {0, 0.2, 0}}};
  scene.bodies = {ball};
  return scene;
}

/// Of frames of one substep each, those whose step is refused, against the same begun as two
/// halves. @return how many there are
int compare_refused(Scene scene, int frames) {
  scene.substeps = 1;
  Simulation tried(scene, "tried", 1), halves(scene, "halves", 1);
  int refused = 0;
  for (int frame = 0; frame < frames; ++frame) {
    SimulationState before, after;
    tried.save(before);
    before.levels = {};
    tried.restore(before);
    tried.advance();
    tried.save(after);
    if (after.levels.first == 0) continue;
    ++refused;
    before.levels.first = 1;
    halves.restore(before);
    halves.advance();
    SimulationState expected;
    halves.save(expected);
    EXPECT_EQ(tried.state_hash(), halves.state_hash()) << frame;
    EXPECT_EQ(after.marks, expected.marks) << frame;
    EXPECT_EQ(after.work.net, expected.work.net) << frame;
  }
  return refused;
}

TEST(StepEnergy, RefusedStepsLeaveNoTrace) {
  EXPECT_GT(compare_refused(set_down(), 6), 0);
  EXPECT_GT(compare_refused(set_down_on_ball(), 6), 0);
}

TEST(StepEnergy, ARunGoesOnInTheSameBitsAcrossRefusedSteps) {
  constexpr int frames = 12;
  const Scene scene = set_down();
  Simulation whole(scene, "whole", 1);
  SimulationState middle, end;
  bool refused = false;
  for (int frame = 0; frame < frames; ++frame) {
    whole.advance();
    whole.save(end);
    if (end.levels.first > 0 && !refused) {
      refused = true;
      middle = end;
    }
  }
  ASSERT_TRUE(refused);
  Simulation resumed(scene, "resumed", 1);
  resumed.restore(middle);
  run(resumed, frames - middle.frame);
  EXPECT_EQ(resumed.state_hash(), whole.state_hash());
  SimulationState again;
  resumed.save(again);
  EXPECT_EQ(again.levels, end.levels);
  EXPECT_EQ(again.work.net, end.work.net);
}

TEST(StepEnergy, TeamsOfAnySizeRefuseTheSameSteps) {
  const auto hash = [](int threads) {
    Scene scene = set_down();
    scene.cloths[0].size = 97;  // shared by the team
    Simulation simulation(scene, "set down", threads);
    SimulationState state;
    for (int frame = 0; frame < 8 && state.levels.first == 0; ++frame) {
      simulation.advance();
      simulation.save(state);
    }
    EXPECT_GT(state.levels.first, 0);  // the last step was refused as a whole
    return simulation.state_hash();
  };
  const std::string one = hash(1);
  for (const int threads : {2, 7}) EXPECT_EQ(hash(threads), one);
}

}  // namespace
}  // namespace weft
