// Bodies that move by positions in memory, what runs away, and what crosses: by the public headers
// alone.
#include <filesystem>

#include <gtest/gtest.h>

#include "tests/contract/sheet_scene.h"
#include "weft/error.h"
#include "weft/mesh.h"
#include "weft/point_cache.h"
#include "weft/run.h"
#include "weft/scene_file.h"
#include "weft/shapes.h"
#include "weft/simulation.h"

namespace weft {
namespace {

using test::hash_of;

constexpr int frames = 12;

/// A sphere that rises by a centimetre a sixtieth of a second.
PointCache rising_sphere() {
  const TriangleMesh mesh = make_shape("sphere");
  PointCache cache;
  cache.points = static_cast<int>(mesh.positions.size());
  for (int k = 0; k < frames; ++k) {
    cache.times.push_back(k);
    for (const Vec3d& p : mesh.positions)
      cache.positions.push_back(vec_cast<float>(p + Vec3d{0, 0.01 * k, 0}));
  }
  cache.times_in_frames = true;
  return cache;
}

Scene sheet_over_ball(Animation animation) {
  SceneBody ball;
  ball.surface = "builtin:sphere";
  ball.size = 33;
  ball.animation = std::move(animation);
  return test::sheet_over(std::move(ball));
}

TEST(MemoryMotion, PointsInMemoryActAsTheirFileDoes) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / "weft-memory-motion.pc2";
  write_pc2(file, rising_sphere());
  const std::string by_file = hash_of(sheet_over_ball(file.string()));
  const PointCache read = read_point_cache(file);
  std::filesystem::remove(file);
  EXPECT_EQ(read.positions, rising_sphere().positions);
  EXPECT_EQ(hash_of(sheet_over_ball({rising_sphere(), "rising"})), by_file);
  EXPECT_NE(hash_of(sheet_over_ball({})), by_file);
}

/// What a simulation says of a motion that it refuses.
std::string refusal_of(PointCache cache) {
  try {
    Simulation(sheet_over_ball({std::move(cache), "given"}), "memory", 1);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::input);
    EXPECT_EQ(error.where(), "given");
    return error.found();
  }
  return "accepted";
}

TEST(MemoryMotion, BrokenMotionsAreRefused) {
  PointCache few = rising_sphere(), late = few, back = few, torn = few, far = few;
  few.points -= 1;
  few.positions.resize(static_cast<std::size_t>(few.points) * frames);
  late.times[0] = 1;
  back.times[5] = 1;
  torn.positions.pop_back();
  far.positions[7].x = NAN;
  EXPECT_NE(refusal_of(few).find("points"), std::string::npos);
  EXPECT_EQ(refusal_of(late), "the time of sample 0 does not follow");
  EXPECT_EQ(refusal_of(back), "the time of sample 5 does not follow");
  EXPECT_NE(refusal_of(torn).find("positions for"), std::string::npos);
  EXPECT_NE(refusal_of(far).find("point 7 in sample 0"), std::string::npos);
  EXPECT_NE(refusal_of({}).find("0 positions"), std::string::npos);
}

TEST(MemoryMotion, IsNotWrittenAsAFile) {
  EXPECT_THROW((void)scene_text(sheet_over_ball({rising_sphere(), "given"}), "scene.json"),
               UsageError);
}

TEST(MemoryMotion, IntersectionsAreCountedWhereCrossedSheetsAre) {
  SceneCloth level, upright;
  level.size = upright.size = 17;
  level.name = "level";
  level.placement.translate = {0, 2, 0};
  // With no row in the level one: what touches along an edge does not cross.
  upright.placement.translate = {0.01, 2.01, 0.013};
  upright.placement.rotate = {83, 0, 0};
  Scene scene;
  scene.cloths = {level, upright};
  const Simulation crossed(scene, "memory", 1);
  EXPECT_GT(crossed.intersections().cloths, 16);
  EXPECT_EQ(crossed.intersections().self, 0);
  scene.cloths[1].placement.translate = {0, 4, 0};
  EXPECT_EQ(Simulation(scene, "memory", 1).intersections().total(), 0);
}

TEST(MemoryMotion, WhatRunsAwayIsToldByItsFields) {
  Scene scene;
  scene.integrator = ExplicitOptions{};
  scene.substeps = 1;
  SceneCloth stiff;
  stiff.name = "stiff";
  stiff.size = 17;
  stiff.pins = {ImagePin{{0, 0}}};
  scene.cloths = {stiff};
  Simulation simulation(scene, "given", 1);
  try {
    for (int frame = 0; frame < 60; ++frame) simulation.advance();
    FAIL() << "nothing was thrown";
  } catch (const Unstable& error) {
    EXPECT_EQ(error.where(), "given");
    EXPECT_EQ(error.place().cloth, "stiff");
    EXPECT_EQ(error.place().frame, simulation.frame() + 1);
    EXPECT_FALSE(error.wanted().empty());
    EXPECT_EQ(std::string(error.what()),
              error.where() + ": " + error.found() + "; " + error.wanted());
  }
}

}  // namespace
}  // namespace weft
