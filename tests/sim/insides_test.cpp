#include "weft/sim/loading/insides.h"

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "tests/sim/refusals.h"
#include "weft/cloth/cloth.h"
#include "weft/convert.h"
#include "weft/error.h"
#include "weft/run/verification.h"

namespace weft {
namespace {

SceneCloth sheet(Vec3d translate, double scale) {
  SceneCloth cloth;
  cloth.name = "sheet";
  cloth.surface = "builtin:sheet";
  cloth.size = 33;
  cloth.placement.scale = {scale, scale, scale};
  cloth.placement.translate = translate;
  return cloth;
}

Scene around(const char* shape, const SceneCloth& cloth) {
  Scene scene;
  scene.ground.reset();
  scene.cloths = {cloth};
  SceneBody body;
  body.name = "room";
  body.surface = std::string("builtin:") + shape;
  body.size = 33;
  body.placement.translate = {0, 0.5, 0};
  scene.bodies = {body};
  return scene;
}

int points_outside(const Simulation& simulation) {
  const ClosedBody body(simulation.bodies()[0].image, simulation.bodies()[0].positions);
  ThreadTeam alone(1);
  std::vector<char> inside;
  body.mark_inside(simulation.cloths()[0].state.position, alone, inside);
  return static_cast<int>(std::count(inside.begin(), inside.end(), 0));
}

/// @param highest  that its centre may lie [m]
void expect_rest_on_floor(const Scene& scene, double highest) {
  Simulation simulation(scene, "s.json", 1);
  ASSERT_EQ(simulation.start_insides().size(), 1U);
  EXPECT_TRUE(simulation.start_insides()[0].kept_in);
  Verifier verifier(simulation, std::nullopt);
  simulation.watch(&verifier);
  Verification found;
  FrameReport last;
  int contacts = 0;
  for (int frame = 1; frame <= 90; ++frame) {
    last = simulation.advance();
    verifier.count_frame(frame, found);
    contacts = std::max(contacts, last.contacts);
    ASSERT_EQ(points_outside(simulation), 0) << "frame " << frame;
    ASSERT_LT(last.strain.p99, 0.05) << "frame " << frame;
    ASSERT_GT(last.smallest_gap, 0) << "frame " << frame;
  }
  EXPECT_TRUE(found.good()) << found.passed.count << " passed, " << found.swallowed.count
                            << " swallowed";
  EXPECT_GT(contacts, 20);
  EXPECT_LT(last.centre_of_mass.y, highest);
  EXPECT_LT(last.kinetic_energy, 0.02);
}

TEST(Insides, AClothInAHollowBallComesToLieOnItsFloor) {
  expect_rest_on_floor(around("sphere", sheet({0, 0.5, 0}, 0.6)), 0.1);
}

TEST(Insides, AClothInABoxComesToLieOnItsFloor) {
  expect_rest_on_floor(around("box", sheet({0, 0.5, 0}, 0.4)), 0.31);  // the floor is at 0.3
}

TEST(Insides, AClothHalfInsideABallIsNamedAndPushedOut) {
  Scene scene = around("sphere", sheet({0.35, 0.62, 0}, 0.5));
  scene.bodies[0].placement.scale = {0.6, 0.6, 0.6};
  Simulation simulation(scene, "s.json", 1);
  ASSERT_EQ(simulation.start_insides().size(), 1U);
  const StartInside& found = simulation.start_insides()[0];
  EXPECT_FALSE(found.kept_in);
  EXPECT_GT(found.samples, 50);
  EXPECT_LT(found.samples, found.particles - 50);
  EXPECT_NE(start_inside_text(found).find("points inside of body 'room'"), std::string::npos);
  for (int frame = 1; frame <= 60; ++frame) simulation.advance();
  const int n = simulation.cloths()[0].model->size;
  EXPECT_EQ(points_outside(simulation), n * n);
}

/// Steps that are refused are halved; in each a point came out by as much as in a whole one, and
/// the run ended as a runaway.
TEST(Insides, WhatBeginsInsideIsPushedOutAsSlowlyInShortSteps) {
  Simulation simulation(around("sphere", sheet({0, 0.9, 0}, 1)), "s.json", 1);
  ASSERT_EQ(simulation.start_insides().size(), 1U);
  EXPECT_GT(simulation.start_insides()[0].samples, 200);
  for (int frame = 1; frame <= 12; ++frame) {
    const FrameReport done = simulation.advance();
    EXPECT_LT(done.kinetic_energy, 0.3) << frame;  // 0.2 kg, that falls at 1.5 m/s
    EXPECT_LT(done.strain.p99, 0.02) << frame;
  }
}

/// A sheet through the middle has no way out: its points would leave by all sides, and tear it.
TEST(Insides, AClothThroughTheMiddleOfABodyIsRefused) {
  for (const char* shape : {"sphere", "torus", "box"}) {
    Scene scene = around(shape, sheet({0, 0.5, 0}, 2));
    scene.cloths[0].size = 97;
    try {
      Simulation simulation(scene, "s.json", 1);
      ADD_FAILURE() << shape;
    } catch (const SceneError& error) {
      EXPECT_NE(std::string(error.what()).find("begins in the middle of body 'room'"),
                std::string::npos)
          << error.what();
    }
  }
}

TEST(Insides, NothingIsInsideOfASurfaceWithABorder) {
  const Simulation simulation(around("cylinder", sheet({0, 0.5, 0}, 0.2)), "s.json", 1);
  EXPECT_TRUE(simulation.start_insides().empty());
}

TEST(Insides, ThePolarMapKeepsNothingIn) {
  Scene scene = around("sphere", sheet({0, 0.5, 0}, 0.3));
  scene.collider = PolarMapOptions{};
  const Simulation simulation(scene, "s.json", 1);
  ASSERT_EQ(simulation.start_insides().size(), 1U);
  EXPECT_FALSE(simulation.start_insides()[0].kept_in);
}

TEST(Insides, AContainerMayMove) {
  Scene scene = around("sphere", sheet({0, 0.4, 0}, 0.5));
  scene.bodies[0].motion = {{0.0, {}, {}}, {0.5, {0, 0, 60}, {0.3, 0.2, 0}}};
  Simulation simulation(scene, "s.json", 1);
  Verifier verifier(simulation, std::nullopt);
  simulation.watch(&verifier);
  Verification found;
  for (int frame = 1; frame <= 45; ++frame) {
    simulation.advance();
    verifier.count_frame(frame, found);
  }
  EXPECT_EQ(points_outside(simulation), 0);
  EXPECT_TRUE(found.good());
}

TEST(Insides, WhatAClosedBodySwallowsIsSeen) {
  // A sheet that is put into a ball between two frames, without crossing it before or after.
  Scene scene = around("sphere", sheet({0, 2.5, 0}, 0.3));
  scene.gravity = {};
  Simulation simulation(scene, "s.json", 1);
  Verifier verifier(simulation, std::nullopt);
  Verification found;
  verifier.count_frame(1, found);
  EXPECT_TRUE(found.good());
  SimulationState state;
  simulation.save(state);
  for (int s = 0; s < 33 * 33; ++s)
    state.cloths[0].position.set(s, state.cloths[0].position.at(s) - Vec3f{0, 2, 0});
  simulation.restore(state);
  verifier.count_frame(2, found);
  EXPECT_EQ(found.swallowed.count, 33 * 33);
  EXPECT_EQ(found.swallowed.frame, 2);
}

/// A ring that stands in a sheet holds less of it than a ball, but has no way out either.
TEST(Insides, ARingThatStandsInAClothIsRefused) {
  for (const double up : {0.0, 0.1}) {
    Scene scene = around("torus", sheet({0, 0.5 + up, 0}, 1));
    scene.cloths[0].size = 65;
    scene.bodies[0].placement.scale = {0.6, 0.6, 0.6};
    scene.bodies[0].placement.rotate = {90, 0, 0};
    EXPECT_NE(test::refusal_of(scene).find("begins in the middle of body 'room'"),
              std::string::npos)
        << up;
  }
}

/// What is a little inside may begin so, in the midst of a cloth and at its border.
TEST(Insides, AClothALittleInsideIsNotRefused) {
  for (const char* shape : {"sphere", "torus", "box", "cone", "rod"}) {
    ConvertOptions options;
    options.size = 33;
    const GeometryImage image = load_surface(std::string("builtin:") + shape, options).image;
    Box3d box;
    for (int s = 0; s < 33 * 33; ++s) box.add(image.world.to_world(image.cube.at(s)));
    for (const double deep : {0.005, 0.03}) {
      Scene scene = around(shape, sheet({}, 1));
      scene.bodies[0].surface = Surface(image, shape);
      scene.bodies[0].placement.translate = {};
      scene.cloths[0].placement.translate = {0.013, box.upper.y - deep, 0.007};
      EXPECT_EQ(test::refusal_of(scene), "") << shape << deep;
    }
  }
}

/// Rows of samples lie in the plane of the box's side, where rounding decides on which side they
/// are: what kept them off the surface drove them in.
TEST(Insides, WhatBeginsOnTheSurfaceIsNotDrivenIn) {
  Scene scene = around("box", sheet({0, 0.69, 0}, 1));
  Simulation simulation(scene, "s.json", 1);
  for (int frame = 1; frame <= 16; ++frame) {
    const FrameReport report = simulation.advance();
    if (frame > 3) {
      EXPECT_GT(report.smallest_gap, -3e-4) << frame;
    }
  }
}

/// Triangles round an edge of the box cross it though all their corners are outside; held off its
/// triangles that they did not cross yet, they stayed for ever.
TEST(Insides, WhatBeginsAcrossAnEdgeComesOffIt) {
  Simulation simulation(around("box", sheet({0.02, 0.69, 0.01}, 1)), "s.json", 1);
  EXPECT_GT(simulation.intersections().bodies, 100);
  for (int frame = 1; frame <= 30; ++frame) simulation.advance();
  EXPECT_EQ(simulation.intersections().bodies, 0);
}

/// As a body does, and by work.
TEST(Insides, TheGroundPushesOutWhatBeginsBelow) {
  Scene scene;
  scene.cloths = {sheet({0, 0.2, 0}, 1)};
  scene.cloths[0].placement.rotate = {90, 0, 0};
  Simulation simulation(scene, "s.json", 1);
  const double start = simulation.start_energy();
  double work = 0;
  FrameReport report;
  for (int frame = 0; frame < 50; ++frame) {
    report = simulation.advance();
    work += report.work;
    EXPECT_LT(report.kinetic_energy + report.potential_energy - start - work,
              1e-3 * simulation.mass() * 9.81);
  }
  EXPECT_GT(report.smallest_gap, 0);
}

/// Which of the two is above nobody can tell: they were thrown apart by the joules.
TEST(Insides, ClothsInTheSamePlaceAreRefused) {
  Scene scene;
  scene.ground.reset();
  scene.cloths = {sheet({0, 1, 0}, 1), sheet({0, 1, 0}, 1)};
  scene.cloths[1].name = "lining";
  const std::string expected = "cloths 'sheet' and 'lining' begin in the same place: 100 %";
  EXPECT_NE(test::refusal_of(scene).find(expected), std::string::npos) << test::refusal_of(scene);
  for (SceneCloth& cloth : scene.cloths) cloth.placement.rotate = {20, 30, 40};
  EXPECT_NE(test::refusal_of(scene).find(expected), std::string::npos) << "in any direction";
  for (SceneCloth& cloth : scene.cloths) cloth.placement.rotate = {};
  scene.cloths[1].placement.translate.x = 0.3;
  EXPECT_NE(test::refusal_of(scene).find("same place"), std::string::npos) << "in part";
  scene.cloths[1].placement.translate.x = 0.99;
  EXPECT_EQ(test::refusal_of(scene), "") << "a row of them";
  scene.cloths[1].placement.translate = {0, 1.001, 0};
  EXPECT_EQ(test::refusal_of(scene), "") << "one above the other";
}

}  // namespace
}  // namespace weft
