// Bodies of several charts: what consists of several pieces is one body.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/convert_options.h"
#include "tests/support/errors.h"
#include "weft/collide/intersections.h"
#include "weft/convert.h"
#include "weft/error.h"
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
  scene.bodies[0].motion = {{0, {0, 0, 0}, {0, 0, 0}}, {0.5, {0, 0.1, 0}, {0, 40, 0}}};
  Simulation simulation(scene, "charts", 1);
  for (int frame = 0; frame < 25; ++frame)
    EXPECT_GT(simulation.advance().smallest_gap, 0) << "frame " << frame;
}

TEST(ChartBodies, CollidersThatCannotTakeThemSaySo) {
  for (const ColliderOptions& collider :
       {ColliderOptions{PolarMapOptions{}}, ColliderOptions{SphereTreeOptions{}}}) {
    Scene scene = sheet_over({balls(2), "balls"});
    scene.collider = collider;
    const std::string said = test::message_of<Error>([&] { Simulation(scene, "scene.json", 1); });
    EXPECT_NE(said.find("'balls' is an image of 2 charts"), std::string::npos) << said;
  }
}

TEST(ChartBodies, ClothOfSeveralPiecesIsRefusedInOneLine) {
  Scene scene = sheet_over({balls(2), "balls"});
  scene.cloths[0].surface = Surface(balls(2), "two");
  const std::string mesh = test::message_of<Error>([&] { Simulation(scene, "scene.json", 1); });
  EXPECT_NE(mesh.find("2 components"), std::string::npos) << mesh;
  const GeometryImage image = convert_mesh(balls(2), "two", unmeasured(65)).image;
  scene.cloths[0].surface = Surface(image, "two");
  const std::string charts = test::message_of<Error>([&] { Simulation(scene, "scene.json", 1); });
  EXPECT_NE(charts.find("2 charts"), std::string::npos) << charts;
}

}  // namespace
}  // namespace weft
