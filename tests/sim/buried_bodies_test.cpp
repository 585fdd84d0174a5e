#include "weft/sim/stepping/buried_bodies.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/sim/falling_sheet.h"
#include "weft/point_cache.h"
#include "weft/run/verification.h"
#include "weft/shapes.h"
#include "weft/simulation.h"

namespace weft::buried_bodies_test {
namespace {

constexpr double radius = 0.2, gap = 0.002;  // [m]
const Vec3d lower_centre{0, 0.3, 0};

/// Two balls of one mesh, one above the other, whose centres are `apart`. [m]
TriangleMesh two_balls(double apart) {
  const TriangleMesh ball = make_shape("sphere");
  double half = 0;
  for (const Vec3d p : ball.positions) half = std::max(half, length(p));
  TriangleMesh mesh;
  for (const Vec3d centre : {lower_centre, lower_centre + Vec3d{0, apart, 0}}) {
    const int first = static_cast<int>(mesh.positions.size());
    for (const Vec3d p : ball.positions) mesh.positions.push_back(centre + (radius / half) * p);
    for (const auto& [a, b, c] : ball.triangles)
      mesh.triangles.push_back({first + a, first + b, first + c});
  }
  return mesh;
}

/// An image of a mesh, and which of its samples lie in it.
struct Marked {
  explicit Marked(const TriangleMesh& mesh)
      : image(load_surface({mesh, "balls"}, {.size = 65}).image),
        positions(placed_positions(image, placement_map({}))) {
    BuriedSamples samples(image, positions, gap);
    EXPECT_TRUE(samples.closed());
    ThreadTeam team(2);
    samples.find(team, marks);
  }
  [[nodiscard]] auto count(char mark) const { return std::count(marks.begin(), marks.end(), mark); }
  GeometryImage image;
  Planes3 positions;
  std::vector<char> marks;
};

/// How far a point of one ball is outside of the other. [m]
double outside_other(Vec3d p, double apart) {
  const double lower = length(p - lower_centre),
               upper = length(p - lower_centre - Vec3d{0, apart, 0});
  return (std::abs(lower - radius) < std::abs(upper - radius) ? upper : lower) - radius;
}

TEST(BuriedSamples, AreThoseInTheOtherOfTwoBalls) {
  constexpr double apart = 0.28, coarse = 0.004;
  const Marked balls(two_balls(apart));
  for (int s = 0; s < static_cast<int>(balls.marks.size()); ++s) {
    const double outside = outside_other(vec_cast<double>(balls.positions.at(s)), apart);
    if (outside < -coarse) {
      EXPECT_EQ(balls.marks[s], 2) << s;
    } else if (outside > coarse + gap) {
      EXPECT_EQ(balls.marks[s], 0) << s;
    }
  }
  EXPECT_GT(balls.count(2), 100);
}

TEST(BuriedSamples, HaveNoRoomBeforeThemWhereSidesNearlyTouch) {
  const Marked near(two_balls(2 * radius + 0.25 * gap)), far(two_balls(2 * radius + 3 * gap));
  EXPECT_EQ(near.count(2), 0);
  EXPECT_GT(near.count(1), 0);
  EXPECT_EQ(far.count(1) + far.count(2), 0);
}

TEST(BuriedSamples, AreTheSameOfABodyTurnedInsideOut) {
  TriangleMesh mesh = two_balls(0.28);
  const Marked balls(mesh);
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  const Marked turned(mesh);
  EXPECT_GT(balls.count(2), 100);
  EXPECT_NEAR(turned.count(2), balls.count(2), 0.1 * balls.count(2));
}

/// The frame at which both part again.
constexpr int parts = 30;

/// The upper ball comes down on a sheet between both, 5 cm deep into the lower one, and goes up
/// again.
Scene pressed_between() {
  constexpr int samples = 50, begins = 10;
  const TriangleMesh mesh = two_balls(0.6);
  PointCache cache;
  cache.points = static_cast<int>(mesh.positions.size());
  for (int k = 0; k < samples; ++k) {
    cache.times.push_back(k / 60.0);
    const double down = 0.25 * std::clamp(1 - std::abs(k - parts) / (1.0 * parts - begins), 0., 1.);
    for (int v = 0; v < cache.points; ++v)
      cache.positions.push_back(
          vec_cast<float>(mesh.positions[v] - Vec3d{0, v < cache.points / 2 ? 0 : down, 0}));
  }
  Scene scene;
  scene.ground.reset();
  scene.cloths = {testing::sheet(25, {0, 0.56, 0})};
  scene.cloths[0].placement.scale = {0.8, 0.8, 0.8};
  SceneBody body;
  body.name = "balls";
  body.size = 65;
  body.surface = {mesh, "balls"};
  body.animation = {cache, "press"};
  scene.bodies = {body};
  return scene;
}

TEST(BuriedBodies, LetClothLieBetweenSidesThatCross) {
  Simulation simulation(pressed_between(), "scene", 1);
  Verifier verifier(simulation, std::nullopt);
  simulation.watch(&verifier);
  Verification found;
  int buried = 0, fell_back = 0;
  FrameReport report;
  for (int frame = 1; frame <= 60; ++frame) {
    report = simulation.advance();
    verifier.count_frame(frame, found);
    if (frame <= parts) {
      EXPECT_EQ(found.passed.count, 0) << "frame " << frame;
    }
    buried = std::max(buried, report.buried);
    fell_back = std::max(fell_back, report.fell_back);
    EXPECT_EQ(simulation.intersections().total(), 0) << "frame " << frame;
  }
  EXPECT_GT(buried, 50);
  EXPECT_EQ(report.buried, 0);
  EXPECT_EQ(fell_back, 0);
  const ClosedBody body(simulation.bodies()[0].image, simulation.bodies()[0].positions);
  const Planes3& cloth = simulation.cloths()[0].state.position;
  for (int s = 0; s < cloth.size() * cloth.size(); ++s)
    EXPECT_FALSE(body.holds(vec_cast<double>(cloth.at(s)))) << "sample " << s;
}

TEST(BuriedBodies, HaveTheSameBitsForAnyTeamAndAfterAResume) {
  constexpr int kept_at = 27, last = 34;
  const Scene scene = pressed_between();
  Simulation whole(scene, "scene", 1), shared(scene, "scene", 2), resumed(scene, "scene", 1);
  SimulationState state;
  for (int frame = 0; frame < last; ++frame) {
    if (frame == kept_at) whole.save(state);
    whole.advance();
    shared.advance();
  }
  resumed.restore(state);
  for (int frame = kept_at; frame < last; ++frame) resumed.advance();
  EXPECT_EQ(shared.state_hash(), whole.state_hash());
  EXPECT_EQ(resumed.state_hash(), whole.state_hash());
}

TEST(BuriedBodies, AreToldOfAtTheStart) {
  Scene scene = pressed_between();
  scene.bodies[0].surface = {two_balls(0.28), "balls"};
  scene.bodies[0].animation = {};
  scene.cloths[0].placement.translate = {0, 1, 0};
  const Simulation simulation(scene, "scene", 1);
  ASSERT_EQ(simulation.notes().size(), 1U);
  EXPECT_NE(simulation.notes()[0].find("body 'balls' crosses itself"), std::string::npos)
      << simulation.notes()[0];
  EXPECT_TRUE(simulation.bodies()[0].buried.empty()) << "it keeps cloth off all of itself";
}

TEST(BuriedBodies, StayMarkedOnceTheyHaveMovedAlsoAfterAResume) {
  constexpr int last = 8;
  Scene scene = pressed_between();
  const TriangleMesh mesh = two_balls(0.28);
  PointCache cache;
  cache.points = static_cast<int>(mesh.positions.size());
  // The upper ball goes up in frames 3 and 4, and comes back to where it began.
  for (int k = 0; k <= last; ++k) {
    cache.times.push_back(k / 60.0);
    for (int v = 0; v < cache.points; ++v)
      cache.positions.push_back(vec_cast<float>(
          mesh.positions[v] + Vec3d{0, v >= cache.points / 2 && k == 3 ? 0.02 : 0, 0}));
  }
  scene.bodies[0].surface = {mesh, "balls"};
  scene.bodies[0].animation = {cache, "nod"};
  scene.cloths[0].placement.translate = {0, 1, 0};
  Simulation whole(scene, "scene", 1), resumed(scene, "scene", 1);
  SimulationState state;
  for (int frame = 0; frame < last; ++frame) {
    if (frame == last - 1) whole.save(state);
    whole.advance();
    EXPECT_EQ(whole.bodies()[0].buried.empty(), frame < 2) << frame;
  }
  resumed.restore(state);
  EXPECT_FALSE(resumed.bodies()[0].buried.empty());
  resumed.advance();
  EXPECT_EQ(resumed.bodies()[0].buried, whole.bodies()[0].buried);
}

TEST(BuriedBodies, KeepClothOffWhereSidesAreNextToEachOtherFromTheBegin) {
  Scene scene = pressed_between();
  scene.bodies[0].surface = {two_balls(2 * radius + 0.25 * gap), "balls"};
  scene.bodies[0].animation = {};
  scene.cloths[0].placement.translate = {0, 1, 0};
  const Simulation simulation(scene, "scene", 1);
  EXPECT_TRUE(simulation.bodies()[0].buried.empty());
  EXPECT_TRUE(simulation.notes().empty());
}

TEST(BuriedBodies, AreNoneOfABodyThatKeepsClothIn) {
  Scene scene = pressed_between();
  scene.bodies[0].surface = {two_balls(0.28), "balls"};
  scene.bodies[0].animation = {};
  scene.cloths[0].placement = {{0.1, 0.1, 0.1}, {}, {0, 0.3, 0}};
  const Simulation simulation(scene, "scene", 1);
  ASSERT_EQ(simulation.start_insides().size(), 1U);
  EXPECT_TRUE(simulation.start_insides()[0].kept_in);
  EXPECT_TRUE(simulation.bodies()[0].buried.empty());
}

}  // namespace
}  // namespace weft::buried_bodies_test
