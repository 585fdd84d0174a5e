// Cloth that is held and pulled at while it is simulated.
#include <gtest/gtest.h>

#include "weft/collide/intersections.h"
#include "weft/error.h"
#include "weft/geometry_image.h"
#include "weft/simulation.h"

namespace weft {
namespace {

constexpr int n = 17, middle = n / 2 * n + n / 2;

Scene floating_sheet(double height) {
  Scene scene;
  scene.substeps = 2;
  SceneCloth cloth;
  cloth.size = n;
  cloth.placement.translate = {0, height, 0};
  scene.cloths = {cloth};
  return scene;
}

Vec3d place_of(const Simulation& simulation, int sample) {
  return vec_cast<double>(simulation.cloths()[0].state.position.at(sample));
}

void advance_by(Simulation& simulation, int frames) {
  for (int i = 0; i < frames; ++i) simulation.advance();
}

TEST(Grab, WhatIsHeldGoesWhereItIsPulledAndTheClothFollows) {
  Simulation simulation(floating_sheet(0.1), "sheet", 1);
  advance_by(simulation, 30);
  const double lying = simulation.centre_of_mass().y;
  simulation.grab(0, middle);
  const Vec3d target = place_of(simulation, middle) + Vec3d{0.1, 0.8, 0};
  simulation.pull(target);
  advance_by(simulation, 60);
  EXPECT_LT(length(place_of(simulation, middle) - target), 1e-6);
  EXPECT_GT(simulation.centre_of_mass().y, lying + 0.3);
  EXPECT_TRUE(simulation.holds());
  simulation.let_go();
  advance_by(simulation, 90);
  EXPECT_FALSE(simulation.holds());
  EXPECT_LT(simulation.centre_of_mass().y, lying + 0.25);
}

TEST(Grab, RefusesSamplesOutsideTheImage) {
  Simulation simulation(floating_sheet(0.3), "sheet", 1);
  for (const int sample : {-1, n * n}) {
    EXPECT_THROW(simulation.grab(0, sample), SceneError);
    EXPECT_FALSE(simulation.holds());
  }
}

TEST(Grab, WhatWasLetGoBeforeAStepLeavesNoTrace) {
  Simulation touched(floating_sheet(0.3), "sheet", 1), untouched(floating_sheet(0.3), "sheet", 1);
  advance_by(touched, 5);
  advance_by(untouched, 5);
  touched.grab(0, middle);
  touched.pull({3, 3, 3});
  touched.let_go();
  advance_by(touched, 20);
  advance_by(untouched, 20);
  EXPECT_EQ(touched.state_hash(), untouched.state_hash());
}

TEST(Grab, GoesNoFasterThanAHand) {
  Scene scene = floating_sheet(0);
  scene.ground.reset();
  scene.gravity = {};
  Simulation simulation(scene, "sheet", 1);
  simulation.grab(0, middle);
  simulation.pull({0, 100, 0});
  for (int frame = 0; frame < 20; ++frame) {
    const double before = place_of(simulation, middle).y;
    simulation.advance();
    EXPECT_LE(place_of(simulation, middle).y - before, 3.0 / 60 + 1e-6);
  }
  EXPECT_GT(place_of(simulation, middle).y, 0.3);
}

TEST(Grab, PullsClothThatIsHeldElsewhereNoLongerThanItStretches) {
  Scene scene = floating_sheet(1);
  scene.cloths[0].pins = {ImagePin{{0, 0}}, ImagePin{{1, 0}}};
  Simulation simulation(scene, "sheet", 1);
  simulation.grab(0, n * n - 1);
  simulation.pull({0, -1, 20});
  FrameReport report;
  for (int frame = 0; frame < 90; ++frame) report = simulation.advance();
  EXPECT_GT(place_of(simulation, n * n - 1).z, 0.4);
  EXPECT_LT(report.strain.max, 0.5);
}

TEST(Grab, DoesNotTakeClothBelowTheGround) {
  Simulation simulation(floating_sheet(0.2), "sheet", 1);
  simulation.grab(0, middle);
  simulation.pull({0, -1, 0});
  advance_by(simulation, 40);
  EXPECT_GT(place_of(simulation, middle).y, 0.0);
}

TEST(Grab, NothingIsPulledThroughABodyOrThroughItself) {
  Scene scene = floating_sheet(1.02);
  scene.cloths[0].size = 33;
  SceneBody ball;
  ball.surface = "builtin:sphere";
  ball.size = 33;
  ball.placement.translate = {0, 0.5, 0};
  scene.bodies = {ball};
  Simulation simulation(scene, "sheet", 1);
  const std::vector<Triangle> cloth = grid_triangles(simulation.cloths()[0].image);
  const std::vector<Triangle> body = grid_triangles(simulation.bodies()[0].image);
  const GridTriangles moving{&simulation.cloths()[0].state.position, &cloth};
  const GridTriangles still{&simulation.bodies()[0].positions, &body};
  IntersectionCheck check({&moving, 1}, {&still, 1}, scene.ground);
  // Down into the ball, then up through the folds.
  const std::vector<Vec3d> pulls{{0, 0.5, 0.1}, {0.6, 1.2, 0.3}, {-0.6, 0.8, -0.2}};
  simulation.advance();
  simulation.grab(0, 16 * 33 + 16);
  for (const Vec3d pull : pulls) {
    simulation.pull(pull);
    for (int frame = 0; frame < 12; ++frame) {
      simulation.advance();
      ASSERT_EQ(check.count().total(), 0) << "frame " << simulation.frame();
    }
  }
}

TEST(Grab, APinStaysWhereItWasTaken) {
  Scene scene = floating_sheet(1);
  scene.cloths[0].pins = {ImagePin{{0, 0}}};
  Simulation simulation(scene, "sheet", 1);
  const Vec3d target = place_of(simulation, 0) + Vec3d{0, 0.2, 0};
  simulation.grab(0, 0);
  simulation.pull(target);
  advance_by(simulation, 30);
  simulation.let_go();
  advance_by(simulation, 30);
  EXPECT_LT(length(place_of(simulation, 0) - target), 1e-6);
}

TEST(Grab, ResetLetsGo) {
  Simulation simulation(floating_sheet(0.5), "sheet", 1);
  SimulationState start;
  simulation.save(start);
  advance_by(simulation, 10);
  const std::string untouched = simulation.state_hash();
  simulation.grab(0, middle);
  simulation.pull({0, 2, 0});
  advance_by(simulation, 10);
  simulation.restore(start);
  EXPECT_FALSE(simulation.holds());
  advance_by(simulation, 10);
  EXPECT_EQ(simulation.state_hash(), untouched);
}

TEST(Grab, ResetTakesPinsBackToWhereTheyWere) {
  Scene scene = floating_sheet(0.5);
  scene.cloths[0].pins = {ImagePin{{0, 0}}, ImagePin{{1, 0}}};
  Simulation simulation(scene, "sheet", 1);
  advance_by(simulation, 3);
  SimulationState saved;
  simulation.save(saved);
  advance_by(simulation, 5);
  const std::string untouched = simulation.state_hash();
  simulation.grab(0, 0);
  simulation.pull({0, 2, 0});
  advance_by(simulation, 5);
  simulation.restore(saved);
  advance_by(simulation, 5);
  EXPECT_EQ(simulation.state_hash(), untouched);
}

TEST(Grab, CorrectionsOfEverySampleHaveTheResidualAsTheLargest) {
  for (const IntegratorOptions& integrator :
       {IntegratorOptions{MultigridOptions{}}, IntegratorOptions{ImplicitOptions{}}}) {
    Scene scene = floating_sheet(1);
    scene.substeps = 1;
    scene.integrator = integrator;
    scene.cloths[0].pins = {ImagePin{{0, 0}}};
    Simulation simulation(scene, "sheet", 1);
    FrameReport report;
    for (int frame = 0; frame < 10; ++frame) report = simulation.advance();
    Grid<float> sizes(n, n);
    ASSERT_TRUE(simulation.last_corrections(0, sizes));
    float largest = 0;
    for (int s = 0; s < n * n; ++s) largest = std::max(largest, sizes(s / n, s % n));
    EXPECT_GT(largest, 0);
    EXPECT_NEAR(largest, report.residual, 1e-3 * report.residual);
  }
}

TEST(SurfaceCache, WhatItKeptMakesTheSameSimulation) {
  Scene scene = floating_sheet(1);
  scene.bodies = {SceneBody{"ball", "builtin:sphere", 33, {}, 0.4, {}, {}, 0}};
  SurfaceCache surface_cache;
  Simulation first(scene, "sheet", 1, {nullptr, &surface_cache}),
      again(scene, "sheet", 1, {nullptr, &surface_cache});
  Simulation alone(scene, "sheet", 1);
  for (Simulation* simulation : {&first, &again, &alone}) advance_by(*simulation, 20);
  EXPECT_EQ(first.state_hash(), alone.state_hash());
  EXPECT_EQ(again.state_hash(), alone.state_hash());
}

}  // namespace
}  // namespace weft
