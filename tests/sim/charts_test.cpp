// Bodies and cloths of several charts.
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "tests/cloth/cut_sheet.h"
#include "tests/sim/refusals.h"
#include "tests/support/convert_options.h"
#include "weft/collide/broad_phase/coherent_pairs.h"
#include "weft/collide/broad_phase/pyramid_pairs.h"
#include "weft/collide/intersections.h"
#include "weft/convert.h"
#include "weft/core/math.h"
#include "weft/error.h"
#include "weft/image/diagonals.h"
#include "weft/scene_file.h"
#include "weft/shapes.h"
#include "weft/simulation.h"

namespace weft {
namespace {

using test::single_chart;
using test::sized;
using test::unmeasured;

TriangleMesh balls(int count) {
  const TriangleMesh ball = make_shape("sphere");
  TriangleMesh mesh;
  for (int k = 0; k < count; ++k) {
    const auto first = static_cast<int>(mesh.positions.size());
    for (const Vec3d p : ball.positions)
      mesh.positions.push_back(0.36 * p + Vec3d{0.4 * (k - 0.5 * (count - 1)), 0.2, 0});
    for (const auto& [a, b, c] : ball.triangles)
      mesh.triangles.push_back({first + a, first + b, first + c});
  }
  return mesh;
}

Scene sheet_over(Surface surface) {
  Scene scene;
  SceneCloth sheet;
  sheet.size = 33;
  sheet.placement.translate = {0, 0.42, 0};
  scene.cloths = {sheet};
  SceneBody body;
  body.name = "balls";
  body.surface = std::move(surface);
  body.size = 65;
  scene.bodies = {body};
  return scene;
}

TEST(ChartBodies, ClothLiesOnAllPiecesAndPassesThroughNone) {
  Simulation simulation(sheet_over({balls(3), "balls"}), "charts", 1);
  EXPECT_EQ(simulation.bodies()[0].image.mates.charts().size(), 3U);
  double lowest_over_balls[3] = {1, 1, 1};
  for (int frame = 0; frame < 40; ++frame) {
    const FrameReport report = simulation.advance();
    EXPECT_GT(report.smallest_gap, 0) << "frame " << frame;
  }
  const Planes3& position = simulation.cloths()[0].state.position;
  for (int s = 0; s < 33 * 33; ++s)
    for (int k = 0; k < 3; ++k) {
      const Vec3d p = vec_cast<double>(position.at(s));
      if (std::hypot(p.x - 0.4 * (k - 1), p.z) < 0.03)
        lowest_over_balls[k] = std::min(lowest_over_balls[k], p.y);
    }
  for (const double lowest : lowest_over_balls) EXPECT_NEAR(lowest, 0.38, 0.02);
}

TEST(ChartBodies, TheSameBitsOnEveryTeam) {
  std::string first;
  for (const int threads : {1, 2, 3}) {
    Simulation simulation(sheet_over({balls(2), "balls"}), "charts", threads);
    for (int frame = 0; frame < 15; ++frame) simulation.advance();
    if (threads == 1) first = simulation.state_hash();
    EXPECT_EQ(simulation.state_hash(), first) << threads << " threads";
  }
}

TEST(ChartBodies, MoveAsOne) {
  Scene scene = sheet_over({balls(2), "balls"});
  scene.bodies[0].motion = {{0, {}, {}}, {0.5, {0, 40, 0}, {0, 0.1, 0}}};
  Simulation simulation(scene, "charts", 1);
  for (int frame = 0; frame < 25; ++frame)
    EXPECT_GT(simulation.advance().smallest_gap, 0) << "frame " << frame;
}

/// A coil of six turns, which the image of one chart holds badly.
TriangleMesh coil() {
  constexpr int around = 6, rings = 180;
  TriangleMesh mesh;
  for (int i = 0; i <= rings; ++i)
    for (int k = 0; k < around; ++k) {
      const double angle = 12 * pi * i / rings, across = 2 * pi * k / around;
      const double radius = 0.15 + 0.006 * cosine(across);
      mesh.positions.push_back(
          {radius * cosine(angle), 0.0025 * i + 0.006 * sine(across) - 0.1, radius * sine(angle)});
    }
  for (int i = 0; i < rings; ++i)
    for (int k = 0; k < around; ++k) {
      const int a = i * around + k, b = i * around + (k + 1) % around;
      mesh.triangles.push_back({a, b, b + around});
      mesh.triangles.push_back({a, b + around, a + around});
    }
  return mesh;
}

TEST(ChartBodies, PoorOnesStayWholeForMethodsThatKnowOneChartOnly) {
  Scene scene = sheet_over({coil(), "coil"});
  scene.bodies[0].size = 97;
  EXPECT_GT(Simulation(scene, "s", 1).bodies()[0].image.mates.charts().size(), 1U);
  scene.integrator = ImplicitOptions{};  // of cloths only: bodies are the collider's
  EXPECT_GT(Simulation(scene, "s", 1).bodies()[0].image.mates.charts().size(), 1U);
  for (const ColliderOptions& collider :
       {ColliderOptions{PolarMapOptions{}}, ColliderOptions{SpatialHashOptions{}}}) {
    scene.collider = collider;
    EXPECT_TRUE(Simulation(scene, "s", 1).bodies()[0].image.has_one_chart());
  }
}

TEST(ChartCloths, PoorOnesStayWholeForMethodsThatKnowOneChartOnly) {
  Scene scene;
  SceneCloth cloth;
  cloth.surface = Surface(coil(), "coil");
  cloth.self_collision = false;
  cloth.size = 97;
  scene.cloths = {cloth};
  EXPECT_GT(Simulation(scene, "s", 1).cloths()[0].image.mates.charts().size(), 1U);
  Scene other = scene;
  other.collider = SpatialHashOptions{};
  EXPECT_TRUE(Simulation(other, "s", 1).cloths()[0].image.has_one_chart());
  scene.integrator = ImplicitOptions{};
  EXPECT_TRUE(Simulation(scene, "s", 1).cloths()[0].image.has_one_chart());
}

TEST(ChartBodies, CollidersThatCannotTakeThemSaySo) {
  for (const ColliderOptions& collider :
       {ColliderOptions{PolarMapOptions{}}, ColliderOptions{SphereTreeOptions{}}}) {
    Scene scene = sheet_over({balls(2), "balls"});
    scene.collider = collider;
    const std::string said = test::refusal_of(scene);
    EXPECT_NE(said.find("'balls' is an image of 2 charts"), std::string::npos) << said;
  }
}

/// The image of a sheet cut into charts, 1 m wide.
GeometryImage image_of(const testing::CutSheet& sheet) {
  GeometryImage image;
  image.mates = sheet.mates;
  image.world.lower = {-0.5, 0, -0.5};
  image.cube = sheet.rest;
  for (int s = 0; s < sheet.rest.size() * sheet.rest.size(); ++s)
    image.cube.set(s, sheet.rest.at(s) + Vec3f{0.5F, 0, 0.5F});
  return image;
}

/// A sheet in charts in place of the square that lies over balls.
Scene charts_over_balls(const GeometryImage& image, int count) {
  Scene scene = sheet_over({balls(count), "balls"});
  scene.cloths[0].surface = Surface(image, "cut");
  return scene;
}

TEST(ChartCloths, ACutSheetLiesAsTheUncutOneDoes) {
  Scene whole = sheet_over({balls(1), "ball"});
  whole.cloths[0].size = 49;
  const Scene cut = charts_over_balls(image_of({49, testing::pinwheel(49)}), 1);
  Simulation uncut(whole, "uncut", 1), charts(cut, "charts", 1);
  EXPECT_EQ(charts.cloths()[0].image.mates.charts().size(), 5U);
  for (int frame = 0; frame < 25; ++frame) {
    const FrameReport here = charts.advance(), there = uncut.advance();
    EXPECT_GT(here.smallest_gap, 0) << "frame " << frame;
    // Folds about the ball are chaotic: a sample moved by a micrometre moves the centre of the
    // uncut sheet by up to 8 mm, and that of the charts by up to 12; distances grow five times a
    // frame once it lies there.
    const double most = frame < 8 ? 5e-5 : frame < 10 ? 1e-3 : 0.015;
    EXPECT_LT(length(here.centre_of_mass - there.centre_of_mass), most) << "frame " << frame;
  }
}

TEST(ChartCloths, TheSameBitsOnEveryTeam) {
  std::string first;
  for (const int threads : {1, 2, 3}) {
    Simulation simulation(charts_over_balls(image_of({49, testing::quarters(49)}), 2), "charts",
                          threads);
    for (int frame = 0; frame < 12; ++frame) simulation.advance();
    if (threads == 1) first = simulation.state_hash();
    EXPECT_EQ(simulation.state_hash(), first) << threads << " threads";
  }
}

TEST(ChartCloths, AMeshOfSeveralPiecesIsOneCloth) {
  Scene scene = sheet_over({balls(1), "ball"});
  scene.cloths[0].surface = Surface(balls(2), "two");
  scene.cloths[0].size = 65;
  scene.cloths[0].placement.translate = {0, 0.5, 0};
  Simulation simulation(scene, "charts", 1);
  EXPECT_EQ(simulation.cloths()[0].image.mates.charts().size(), 2U);
  for (int frame = 0; frame < 20; ++frame)
    EXPECT_GT(simulation.advance().smallest_gap, 0) << "frame " << frame;
}

TEST(ChartCloths, WhatCannotTakeThemSaysSo) {
  const Scene sound = charts_over_balls(image_of({33, testing::quarters(33)}), 1);
  Scene scene = sound;
  scene.integrator = ImplicitOptions{};
  EXPECT_NE(test::refusal_of(scene).find("the integrator newton"), std::string::npos);
  scene = sound;
  scene.collider = SpatialHashOptions{};
  EXPECT_NE(test::refusal_of(scene).find("the collider pyramid"), std::string::npos);
  scene = sound;
  scene.cloths[0].pins = {ImagePin{{0.5, 0.5}}};
  EXPECT_NE(test::refusal_of(scene).find("between the charts"), std::string::npos);
  // Three pages on one spine.
  scene = sound;
  scene.cloths[0].surface =
      Surface(TriangleMesh{{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {-1, 0, 1}, {-1, 0, -1}},
                           {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}},
              "pages");
  EXPECT_NE(test::refusal_of(scene).find("edges of more than two triangles"), std::string::npos)
      << test::refusal_of(scene);
}

/// Cells that meet where charts do are neighbours of the cloth, as if it were uncut.
TEST(ChartCloths, FindNothingNearWhereChartsMeet) {
  constexpr float skin = 0.002F, reach = 0.004F, slack = 0.0003F;
  for (const auto& parts : {testing::quarters(65), testing::pinwheel(65)}) {
    const testing::CutSheet sheet(65, parts);
    const GeometryImage image = image_of(sheet);
    const SurfaceGrid grid(image.size(), image.mates, choose_diagonals(image));
    const std::array<const SurfaceGrid*, 1> grids{&grid};
    ThreadTeam alone(1);
    CoherentPairs pairs(std::make_unique<PyramidPairs>(grids, 1), grids, 1, skin);
    Planes3 bent = sheet.rest;
    for (int s = 0; s < bent.size() * bent.size(); ++s) {
      const Vec3f at = bent.at(s);
      bent.set(s, {at.x, 0.3F * at.x * at.z, at.z});
    }
    for (const Planes3* positions : {&sheet.rest, &std::as_const(bent)}) {
      pairs.refit(std::array{MovingSurface{&grid, positions, positions}}, alone);
      EXPECT_TRUE(pairs.find_self(0, reach, slack, alone).empty()) << parts.size() << " charts";
    }
  }
}

/// Flat squares of a metre side by side.
TriangleMesh squares(int count) {
  TriangleMesh mesh;
  for (int k = 0; k < count; ++k) {
    const double x = 2.0 * k;
    for (const Vec3d p : {Vec3d{x, 0, 0}, Vec3d{x, 0, 1}, Vec3d{x + 1, 0, 1}, Vec3d{x + 1, 0, 0}})
      mesh.positions.push_back(p);
    mesh.triangles.push_back({4 * k, 4 * k + 1, 4 * k + 2});
    mesh.triangles.push_back({4 * k, 4 * k + 2, 4 * k + 3});
  }
  return mesh;
}

// Between the charts of such an image lie samples of none, which have no weight.
TEST(ChartCloths, PiecesFallAsImplicitEulerDoes) {
  for (const int count : {2, 3, 5}) {
    Scene scene;
    scene.ground.reset();
    SceneCloth cloth;
    cloth.surface = {squares(count), "squares"};
    cloth.size = 33;
    scene.cloths = {cloth};
    Simulation simulation(scene, "squares", 1);
    const double start = simulation.cloths()[0].state.position.at(0).y;
    const double h = 1.0 / (60 * scene.substeps);
    for (int frame = 1; frame <= 3; ++frame) {
      const double steps = scene.substeps * frame;
      const FrameReport report = simulation.advance();
      EXPECT_NEAR(report.centre_of_mass.y - start, -0.5 * 9.81 * h * h * steps * (steps + 1), 1e-7)
          << count << " pieces, frame " << frame;
      EXPECT_LT(report.strain.max, 1e-5);
    }
  }
}

}  // namespace
}  // namespace weft
