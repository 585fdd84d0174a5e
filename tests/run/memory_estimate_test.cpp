#include <cmath>
#include <ostream>

#include <gtest/gtest.h>

#include "tests/support/errors.h"
#include "tests/support/patterns.h"
#include "tests/support/temporary_folder.h"
#include "weft/error.h"
#include "weft/files.h"
#include "weft/garment.h"
#include "weft/image/builtin.h"
#include "weft/image_file.h"
#include "weft/run.h"
#include "weft/shapes.h"
#include "weft/simulation.h"

namespace weft {
namespace {

constexpr std::uint64_t gb = 1'000'000'000;

Scene sheet(int size) {
  Scene scene;
  scene.cloths.resize(1);
  scene.cloths[0].size = size;
  return scene;
}

/// Balls beside each other.
TriangleMesh balls(int count) {
  const TriangleMesh ball = make_shape("sphere");
  TriangleMesh mesh;
  for (int k = 0; k < count; ++k) {
    const auto first = static_cast<int>(mesh.positions.size());
    for (const Vec3d p : ball.positions) mesh.positions.push_back(p + Vec3d{2.0 * k, 0, 0});
    for (const auto& [a, b, c] : ball.triangles)
      mesh.triangles.push_back({first + a, first + b, first + c});
  }
  return mesh;
}

TEST(MemoryEstimate, GrowsWithSamplesClothsAndBodies) {
  Scene scene = sheet(1001);
  const std::uint64_t one = estimate_memory(scene);
  EXPECT_NEAR(static_cast<double>(estimate_memory(sheet(2001))) / static_cast<double>(one), 4, 0.1);
  scene.cloths.push_back(scene.cloths[0]);
  EXPECT_NEAR(static_cast<double>(estimate_memory(scene)) / static_cast<double>(one), 2, 0.05);
  const std::uint64_t two = estimate_memory(scene);
  scene.bodies.resize(1);
  scene.bodies[0].size = 1001;
  EXPECT_GT(estimate_memory(scene), two + two / 10);
}

TEST(MemoryEstimate, TakesTheSizeOfAnImageFromItsFile) {
  const test::TemporaryFolder folder;
  write_image(folder / "s.exr", make_image_shape("sheet", 65));
  Scene scene = sheet(5);
  scene.cloths[0].surface = folder / "s.exr";
  EXPECT_EQ(estimate_memory(scene), estimate_memory(sheet(65)));
}

TEST(MemoryEstimate, OfLoadedSurfacesIsThatOfTheirSizes) {
  Scene scene = sheet(5);
  scene.bodies.resize(1);
  scene.bodies[0].surface = {balls(12), "balls"};
  scene.bodies[0].size = 9;
  SimulationHelp help;
  LoadedSizes found;
  help.loaded = [&](const LoadedSizes& sizes) {
    found = sizes;
    throw UsageError("test", "refused", "");
  };
  EXPECT_THROW(Simulation(scene, "s.json", {1, best_instruction_set()}, help), UsageError);
  ASSERT_EQ(found.bodies.size(), 1U);
  EXPECT_GT(found.bodies[0], 9) << "so many charts need more";
  EXPECT_GT(estimate_memory(scene, found), estimate_memory(scene));
  scene.bodies[0].size = found.bodies[0];
  EXPECT_EQ(estimate_memory(scene, found), estimate_memory(scene));
}

TEST(MemoryEstimate, TakesTheSizeOfAGarmentFromThePanelsOfItsPattern) {
  const test::TemporaryFolder folder;
  write_file(folder / "tube.json",
             [](std::ostream& out) { out << test::tube_pattern(100, 100, 20, 0); });
  Scene scene = sheet(5);
  scene.cloths[0].surface = folder / "tube.json";
  scene.cloths[0].spacing = 0.002;
  const int least = min_garment_size(read_pattern(folder / "tube.json"), 0.002);
  EXPECT_NEAR(least, std::sqrt(0.8 * 2) / 0.002, 1);
  EXPECT_EQ(estimate_memory(scene), estimate_memory(sheet(least)));
  scene.cloths[0].surface = folder / "none.json";
  EXPECT_EQ(estimate_memory(scene), estimate_memory(sheet(5)));
}

TEST(MemoryEstimate, WhatCertainlyDoesNotFitIsRefusedWithBothFigures) {
  check_memory(4 * gb, 4 * gb, "s.json");
  EXPECT_EQ(
      test::message_of<SceneError>([] { check_memory(5 * gb, 3 * gb, "s.json"); }),
      "s.json: about 5.0 GB of memory are needed, 3.0 GB are there; smaller sizes are wanted");
  EXPECT_TRUE(is_memory_short(4 * gb, 4 * gb));
  EXPECT_FALSE(is_memory_short(2 * gb, 4 * gb));
}

TEST(MemoryEstimate, RunRefusesBeforeItMakesAnything) {
  const test::TemporaryFolder place;
  Scene scene = sheet(largest_image_size);
  scene.cloths.resize(1000, scene.cloths[0]);
  EXPECT_THROW(run_scene(scene, "s.json", {.folder = place / "run"}), SceneError);
  EXPECT_EQ(place.entries(), 0);
}

}  // namespace
}  // namespace weft
