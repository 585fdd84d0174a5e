#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "weft/run/passings.h"
#include "weft/simulation.h"

namespace weft {
namespace {

Scene one_step_a_frame() {
  Scene scene;
  scene.frame_rate = 240;
  scene.substeps = 1;
  SceneCloth cloth;
  cloth.name = "sheet";
  cloth.surface = "builtin:sheet";
  cloth.size = 25;
  cloth.material = weft::testing::soft_fabric;
  scene.cloths = {cloth};
  return scene;
}

struct Seen {
  int contacts = 0, self_contacts = 0;
};

/// Looks at every step's motion.
class Watcher final : public StepWatcher {
 public:
  explicit Watcher(const Simulation& simulation)
      : cloth_{{&simulation.cloths()[0].image, &simulation.cloths()[0].state.position}},
        check_(cloth_, bodies_of(simulation), std::nullopt) {}
  void see(const StepMotion& step) override {
    passed += check_.count(step);
    ++steps;
  }
  std::int64_t passed = 0;
  int steps = 0;

 private:
  static std::vector<PassingCheck::Surface> bodies_of(const Simulation& simulation) {
    std::vector<PassingCheck::Surface> bodies;
    for (const PlacedBody& body : simulation.bodies())
      bodies.push_back({&body.image, &body.positions});
    return bodies;
  }
  std::array<PassingCheck::Surface, 1> cloth_;
  PassingCheck check_;
};

Seen expect_nothing_passes(const Scene& scene, int frames) {
  Simulation simulation(scene, "s.json", 2);
  Watcher watcher(simulation);
  simulation.watch(&watcher);
  Seen seen;
  for (int frame = 1; frame <= frames; ++frame) {
    const FrameReport report = simulation.advance();
    seen.contacts = std::max(seen.contacts, report.contacts);
    seen.self_contacts = std::max(seen.self_contacts, report.self_contacts);
    EXPECT_EQ(watcher.passed, 0) << "frame " << frame;
  }
  EXPECT_GE(watcher.steps, frames);
  return seen;
}

// Counting triangles that cross at the ends of frames would not see what passes whole in between:
// this follows the ways of all vertices and edges.
TEST(Passing, FastSheetPassesThroughNoThinRodInAnyStep) {
  Scene scene = one_step_a_frame();
  scene.ground = std::nullopt;
  scene.cloths[0].placement.translate = {0, 0.1, 0.013};
  scene.cloths[0].velocity = {0, -6, 0.5};
  SceneBody rod;
  rod.name = "rod";
  rod.surface = "builtin:rod";
  rod.size = 33;
  scene.bodies = {rod};
  EXPECT_GT(expect_nothing_passes(scene, 40).contacts, 10);
}

TEST(Passing, CrumplingSheetPassesThroughItselfInNoStep) {
  Scene scene = one_step_a_frame();
  scene.ground = 0;
  scene.cloths[0].placement.rotate = {80, 0, 7};
  scene.cloths[0].placement.scale = {0.4, 0.4, 0.4};
  scene.cloths[0].placement.translate = {0, 0.22, 0};
  scene.cloths[0].velocity = {0, -4, 0};
  EXPECT_GT(expect_nothing_passes(scene, 150).self_contacts, 5);
}

/// A sheet above a plate, and whatever motion a test gives it.
struct OverPlate {
  OverPlate() : simulation(scene(), "s.json", 1) {
    const PassingCheck::Surface cloth{&simulation.cloths()[0].image, &before()};
    const PassingCheck::Surface body{&simulation.bodies()[0].image, &still()};
    check.emplace(std::span(&cloth, 1), std::span(&body, 1), std::nullopt);
  }
  static Scene scene() {
    Scene scene = one_step_a_frame();
    scene.collider = PolarMapOptions{};
    scene.ground = std::nullopt;
    scene.cloths[0].placement.translate = {0, 0.05, 0};
    SceneBody plate;
    plate.name = "plate";
    plate.surface = "builtin:sheet";
    plate.size = 9;
    plate.placement.translate = {0.01, 0, 0.02};
    scene.bodies = {plate};
    return scene;
  }
  [[nodiscard]] const Planes3& before() const { return simulation.cloths()[0].state.position; }
  [[nodiscard]] const Planes3& still() const { return simulation.bodies()[0].positions; }
  std::int64_t count(const Planes3& after) {
    return count({&before(), &after}, {&still(), &still()});
  }
  std::int64_t count(const StepMotion::Path& cloth, const StepMotion::Path& body) {
    return check->count({std::span(&cloth, 1), std::span(&body, 1)});
  }

  Simulation simulation;
  std::optional<PassingCheck> check;
};

TEST(Passing, WhatDoesPassIsSeen) {
  OverPlate over;
  Planes3 after = over.before();
  EXPECT_EQ(over.count(after), 0);
  for (int s = 0; s < after.size() * after.size(); ++s)
    after.set(s, after.at(s) - Vec3f{0, 0.1F, 0});
  // Nothing crosses before or after; every inner vertex and many edges meet the plate between.
  EXPECT_GT(over.count(after), 500);
}

// What stands still in one step after another is not looked at again: it must be once it moves.
TEST(Passing, ABodyThatStoodStillIsSeenWhereItGoesAndWhereItStopped) {
  OverPlate over;
  const StepMotion::Path hangs{&over.before(), &over.before()};
  Planes3 raised = over.still();
  for (int s = 0; s < raised.size() * raised.size(); ++s)
    raised.set(s, raised.at(s) + Vec3f{0, 0.1F, 0});
  EXPECT_EQ(over.count(hangs, {&over.still(), &over.still()}), 0);
  EXPECT_EQ(over.count(hangs, {&over.still(), &over.still()}), 0);
  EXPECT_GT(over.count(hangs, {&over.still(), &raised}), 500);
  EXPECT_EQ(over.count(hangs, {&raised, &raised}), 0);
  Planes3 after = over.before();
  for (int s = 0; s < after.size() * after.size(); ++s)
    after.set(s, after.at(s) + Vec3f{0, 0.1F, 0});
  EXPECT_GT(over.count({&over.before(), &after}, {&raised, &raised}), 500);
}

TEST(Passing, ASingleVertexThatPassesIsSeen) {
  OverPlate over;
  Planes3 after = over.before();
  // Over the inside of a cell of the plate, so that its edges may meet the cell's diagonal alone.
  constexpr int at = 14;
  after.set(at, at, after.at(at, at) - Vec3f{0, 0.1F, 0});
  const std::int64_t count = over.count(after);
  // The vertex through a face; its six edges perhaps through that diagonal.
  EXPECT_GE(count, 1);
  EXPECT_LE(count, 7);
}

TEST(Passing, ASheetThatFoldsThroughItselfIsSeen) {
  OverPlate over;
  Planes3 after = over.before();
  const int n = after.size();
  // Its left half goes over to lie mirrored above the right one, and through it.
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n / 2; ++c) {
      const Vec3f p = after.at(r, c);
      after.set(r, c, {-p.x + 0.003F, p.y + 0.01F * (c % 2 == 0 ? 1.0F : -1.0F), p.z + 0.004F});
    }
  EXPECT_GT(over.count(after), 0);
}

TEST(Passing, WhatGoesBeneathTheGroundIsCountedOnce) {
  const OverPlate over;
  const PassingCheck::Surface cloth{&over.simulation.cloths()[0].image, &over.before()};
  PassingCheck check(std::span(&cloth, 1), {}, 0.0);
  Planes3 after = over.before();
  after.set(3, 3, {0, -0.01F, 0});
  after.set(7, 9, {0, -0.01F, 0});
  const StepMotion::Path way{&over.before(), &after};
  // Those two, and whatever self-crossings so wild a motion makes, which are counted beside them.
  PassingCheck without(std::span(&cloth, 1), {}, std::nullopt);
  const StepMotion step{std::span(&way, 1), {}};
  EXPECT_EQ(check.count(step) - without.count(step), 2);
}

}  // namespace
}  // namespace weft
