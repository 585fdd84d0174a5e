// The library as others use it: by its public headers alone, nothing in files.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/contract/sheet_scene.h"
#include "weft/convert.h"
#include "weft/error.h"
#include "weft/geometry_image.h"
#include "weft/run.h"
#include "weft/scene_file.h"
#include "weft/shapes.h"
#include "weft/simulation.h"

namespace weft {
namespace {

using test::hash_of;

Scene sheet_on(Surface body) {
  SceneBody ball;
  ball.name = "ball";
  ball.surface = std::move(body);
  ball.size = 33;
  ball.placement.translate = {0, 0.3, 0};
  ball.placement.scale = {0.5, 0.5, 0.5};
  return test::sheet_over(std::move(ball));
}

TEST(MemoryScene, MeshInMemoryActsAsItsNameDoes) {
  const Surface named = "builtin:sphere";
  const Surface given{make_shape("sphere"), "builtin:sphere"};
  EXPECT_EQ(hash_of(sheet_on(given)), hash_of(sheet_on(named)));
}

TEST(MemoryScene, ImageInMemoryActsAsItsFileDoes) {
  ConvertOptions options;
  options.size = 33;
  const GeometryImage image = convert_mesh(make_shape("sphere"), "builtin:sphere", options).image;
  Simulation simulation(sheet_on({image, "ball"}), "memory", 1);
  FrameReport report;
  for (int frame = 0; frame < 12; ++frame) report = simulation.advance();
  EXPECT_GT(report.contacts, 0);
  EXPECT_EQ(simulation.bodies()[0].image.size(), 33);
}

TEST(MemoryScene, MeshThatCannotBecomeAnImageIsNamed) {
  TriangleMesh point = make_shape("sphere");
  for (Vec3d& p : point.positions) p = {0, 0, 0};
  try {
    Simulation(sheet_on({point, "point"}), "memory", 1);
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::input);
    EXPECT_NE(std::string(error.what()).find("point"), std::string::npos) << error.what();
  }
}

/// What a simulation says of a body that it refuses.
std::string refusal_of(Surface body) {
  try {
    Simulation(sheet_on(std::move(body)), "memory", 1);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::input);
    return error.what();
  }
  return "accepted";
}

TEST(MemoryScene, BrokenMeshesAreRefusedInOneLine) {
  TriangleMesh beyond = make_shape("sphere");
  beyond.triangles[3][1] = 1'000'000;
  TriangleMesh not_finite = make_shape("sphere");
  not_finite.positions[5].y = NAN;
  TriangleMesh half_textured = make_shape("sphere");
  half_textured.corner_uv.resize(2);
  for (const TriangleMesh& mesh : {TriangleMesh{}, beyond, not_finite, half_textured}) {
    const std::string said = refusal_of({mesh, "given"});
    EXPECT_TRUE(said.starts_with("given: ")) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos);
  }
}

TEST(MemoryScene, BrokenImagesAreRefusedInOneLine) {
  ConvertOptions options;
  options.size = 33;
  const GeometryImage sound = convert_mesh(make_shape("sphere"), "ball", options).image;
  GeometryImage not_finite = sound, far = sound, no_size = sound, apart = sound, other = sound;
  not_finite.cube.x(4, 4) = NAN;
  far.cube.y(4, 4) = 2;
  no_size.world.scale = 0;
  apart.cube.z(0, 3) += 0.01F;
  other.mates = BorderMates(17, {});
  for (const GeometryImage& image : {GeometryImage{}, not_finite, far, no_size, apart, other}) {
    const std::string said = refusal_of({image, "given"});
    EXPECT_TRUE(said.starts_with("given: ")) << said;
  }
  EXPECT_EQ(refusal_of({sound, "given"}), "accepted");
}

TEST(MemoryScene, WhatIsInMemoryAloneIsNotWrittenAsAFile) {
  const Scene scene = sheet_on({make_shape("sphere"), "ball"});
  EXPECT_THROW(write_scene("scene.json", scene), UsageError);
  EXPECT_GT(estimate_memory(scene), 1'000'000U);
}

TEST(MemoryScene, VerticesOfAMeshAreCarriedByItsSamples) {
  const TriangleMesh ball = make_shape("sphere");
  SceneCloth cloth;
  cloth.surface = {ball, "ball"};
  cloth.size = 33;
  cloth.placement.translate = {0, 3, 0};
  SceneCloth sheet;
  sheet.name = "sheet";
  sheet.size = 9;
  sheet.placement.translate = {5, 3, 0};
  Scene scene;
  scene.cloths = {cloth, sheet};
  const Simulation simulation(scene, "memory", 1);
  const CarriedVertices carried(simulation, 0, cloth.placement);
  const Planes3& rest = simulation.cloths()[0].state.position;
  Planes3 turned = rest;  // by a quarter about x, and moved
  for (int s = 0; s < 33 * 33; ++s) turned.set(s, {rest.at(s).x + 1, -rest.at(s).z, rest.at(s).y});
  const auto there = carried.positions(rest), moved = carried.positions(turned);
  ASSERT_EQ(there.size(), ball.positions.size());
  double at_rest = 0, after = 0;
  for (std::size_t v = 0; v < there.size(); ++v) {
    const Vec3d wanted = ball.positions[v] + Vec3d{0, 3, 0};
    at_rest = std::fmax(at_rest, length(vec_cast<double>(there[v]) - wanted));
    after = std::fmax(
        after, length(vec_cast<double>(moved[v]) - Vec3d{wanted.x + 1, -wanted.z, wanted.y}));
  }
  EXPECT_LT(at_rest, 1e-6);
  EXPECT_LT(after, 1e-5);
  EXPECT_THROW(CarriedVertices(simulation, 1, sheet.placement), UsageError);
}

TEST(MemoryScene, StrainAtSamplesTellsOfStretch) {
  SceneCloth sheet;
  sheet.size = 17;
  sheet.pins = {ImagePin{{0, 0}}, ImagePin{{1, 0}}};
  Scene scene;
  scene.ground.reset();
  scene.cloths = {sheet};
  Simulation simulation(scene, "memory", 1);
  Grid<float> strains(17, 17);
  simulation.strain_at_samples(0, strains);
  EXPECT_NEAR(strains(8, 8), 0, 1e-6);
  for (int frame = 0; frame < 30; ++frame) simulation.advance();
  simulation.strain_at_samples(0, strains);
  float largest = 0;
  for (int r = 0; r < 17; ++r)
    for (int c = 0; c < 17; ++c) largest = std::max(largest, strains(r, c));
  EXPECT_GT(largest, 1e-3);
}

}  // namespace
}  // namespace weft
