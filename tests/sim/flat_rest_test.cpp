// Rest shapes from texture coordinates.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "weft/cloth/measure.h"
#include "weft/core/math.h"
#include "weft/error.h"
#include "weft/files.h"
#include "weft/simulation.h"

namespace weft {
namespace {

using Flat = Vec2f (*)(Vec2f);

/// A flat 1 m square of quads in two halves, with texture coordinates of its own for each.
TriangleMesh halves(Flat left, Flat right) {
  constexpr int side = 12;
  TriangleMesh mesh;
  for (int j = 0; j <= side; ++j)
    for (int i = 0; i <= side; ++i)
      mesh.positions.push_back({double(i) / side, 1, double(j) / side});
  const auto add = [&](int a, int b, int c, bool is_left) {
    mesh.triangles.push_back({a, b, c});
    std::array<Vec2f, 3> corners;
    for (int k = 0; k < 3; ++k) {
      const Vec3d p = mesh.positions[mesh.triangles.back()[k]];
      const Vec2f place{static_cast<float>(p.x), static_cast<float>(p.z)};
      corners[k] = is_left ? left(place) : right(place);
    }
    mesh.corner_uv.push_back(corners);
  };
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const int a = j * (side + 1) + i, b = a + 1, c = b + side + 1, d = a + side + 1;
      add(a, c, b, i < side / 2);
      add(a, d, c, i < side / 2);
    }
  return mesh;
}

/// A tube of radius 0.2 m round the y axis, 0.4 m high, its texture unrolled in one island or two.
TriangleMesh unrolled_tube(double wider, int islands) {
  constexpr int around = 48, along = 12;
  TriangleMesh mesh;
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i < around; ++i) {
      const double a = 2 * pi * i / around;
      mesh.positions.push_back({0.2 * std::cos(a), 1 + 0.4 * j / along, -0.2 * std::sin(a)});
    }
  const double chord = 2 * 0.2 * std::sin(pi / around);
  const auto uv = [&](int i, int j, int island) {
    return Vec2f{static_cast<float>(wider * chord * i + 3 * island),
                 static_cast<float>(0.4 * j / along)};
  };
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      const int a = j * around + i, b = j * around + (i + 1) % around, c = b + around,
                d = a + around, island = i * islands / around;
      const Vec2f low = uv(i, j, island), right = uv(i + 1, j, island),
                  far = uv(i + 1, j + 1, island), high = uv(i, j + 1, island);
      mesh.triangles.push_back({a, b, c});
      mesh.corner_uv.push_back({low, right, far});
      mesh.triangles.push_back({a, c, d});
      mesh.corner_uv.push_back({low, far, high});
    }
  return mesh;
}

Scene worn(TriangleMesh mesh, const TextureRest& rest) {
  Scene scene;
  SceneCloth cloth;
  cloth.surface = Surface(std::move(mesh), "mesh");
  cloth.size = 49;
  cloth.rest = rest;
  scene.cloths.push_back(cloth);
  return scene;
}

StrainSummary strain_at_start(const Simulation& simulation) {
  const SimulatedCloth& cloth = simulation.cloths()[0];
  return measure_strain(*cloth.model, cloth.state);
}

Vec2f same(Vec2f p) { return p; }
Vec2f turned(Vec2f p) { return {0.8F * p.x - 0.6F * p.y + 7, 0.6F * p.x + 0.8F * p.y}; }
Vec2f mirrored(Vec2f p) { return {3 - p.x, p.y}; }
Vec2f thrice(Vec2f p) { return {3 * p.x + 9, 3 * p.y}; }

TEST(FlatRest, IsometricIslandsHaveNoEnergy) {
  // Turned, or turned over: only lengths count.
  for (const Flat right : {same, turned, mirrored}) {
    const Simulation simulation(worn(halves(same, right), {1.0}), "scene", 1);
    EXPECT_LT(strain_at_start(simulation).max, 5e-5);
    const SimulatedCloth& cloth = simulation.cloths()[0];
    EXPECT_LT(potential_energy(*cloth.model, cloth.state, {}), 1e-6);
    EXPECT_EQ(cloth.state.position.at(0).y, 1) << "the cloth begins where its mesh is";
  }
}

TEST(FlatRest, ScaleIsMetresAUnit) {
  const Simulation simulation(worn(halves(same, mirrored), {1.25}), "scene", 1);
  EXPECT_NEAR(strain_at_start(simulation).mean, 0.2, 1e-4);
}

TEST(FlatRest, AutomaticScaleKeepsTheArea) {
  // Placed twice as large.
  Scene scene = worn(halves(thrice, thrice), {});
  scene.cloths[0].placement.scale = {2, 2, 2};
  const Simulation simulation(scene, "scene", 1);
  EXPECT_LT(strain_at_start(simulation).max, 5e-5);
  ASSERT_FALSE(simulation.notes().empty());
  EXPECT_NE(simulation.notes().back().find("uv_scale 0.66666"), std::string::npos)
      << simulation.notes().back();
  EXPECT_NEAR(simulation.mass(), 4 * Material{}.density, 5e-4);
}

TEST(FlatRest, UnrolledTubeIsClosedAndAtRest) {
  const Simulation simulation(worn(unrolled_tube(1, 1), {1.0}), "scene", 1);
  EXPECT_LT(strain_at_start(simulation).max, 3e-3);  // of chords across the mesh's edges
  const SimulatedCloth& cloth = simulation.cloths()[0];
  EXPECT_GT(cloth.model->mates.class_count(), 0);
  for (int k = 0; k < cloth.model->mates.class_count(); ++k)
    for (const int s : cloth.model->mates.copies(k))
      EXPECT_EQ(cloth.state.position.at(s),
                cloth.state.position.at(cloth.model->mates.copies(k)[0]));
}

TEST(FlatRest, WiderTextureMakesTheFabricWider) {
  // The texture is half as wide again: what hangs is gathered, not stretched.
  Scene scene = worn(unrolled_tube(1.5, 2), {1.0});
  scene.cloths[0].size = 25;
  for (const Vec3d place : {Vec3d{0.2, 1.4, 0}, {-0.2, 1.4, 0}, {0, 1.4, 0.2}, {0, 1.4, -0.2}})
    scene.cloths[0].pins.push_back(ScenePin(NearestPin{place}));
  scene.ground.reset();
  Simulation simulation(scene, "scene", 1);
  EXPECT_NEAR(simulation.mass(), 1.5 * 2 * pi * 0.2 * 0.4 * Material{}.density, 1e-3);
  EXPECT_GT(strain_at_start(simulation).mean, 0.1);
  StrainSummary strain;
  for (int frame = 0; frame < 15; ++frame) strain = simulation.advance().strain;
  EXPECT_LT(strain.mean, 0.005);
  EXPECT_EQ(simulation.intersections().total(), 0);
}

TEST(FlatRest, CrushedStartIsNoRunaway) {
  // A texture 1.7 times as wide as the mesh: the fabric begins with all the energy of that.
  Simulation simulation(worn(halves(same, same), {1 / 0.6}), "scene", 1);
  EXPECT_GT(strain_at_start(simulation).mean, 0.39);
  StrainSummary strain;
  for (int frame = 0; frame < 5; ++frame) strain = simulation.advance().strain;
  EXPECT_LT(strain.mean, 0.01);
}

TEST(FlatRest, IsRefusedWithoutAreaOrTexture) {
  const auto error_of = [](const Scene& scene) {
    try {
      const Simulation simulation(scene, "scene", 1);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  TriangleMesh bare = halves(same, same);
  bare.corner_uv.clear();
  EXPECT_NE(error_of(worn(bare, {})).find("not every corner of its faces has texture"),
            std::string::npos);
  const auto squashed = [](Vec2f p) { return Vec2f{p.x, 0}; };
  EXPECT_NE(error_of(worn(halves(same, squashed), {}))
                .find("144 of 288 triangles have no area in the texture"),
            std::string::npos)
      << error_of(worn(halves(same, squashed), {}));
  EXPECT_NE(error_of(worn(halves(squashed, squashed), {})).find("288 of 288"), std::string::npos);
  Scene image = worn(bare, {});
  image.cloths[0].surface = "builtin:sheet";
  EXPECT_NE(error_of(image).find("has no texture coordinates"), std::string::npos);
}

/// How far a strip of 1 m, hung by its upper edge, sinks at its lower end. [m]
double sink_of(Scene scene, Vec3d left, Vec3d right) {
  scene.ground.reset();
  // Long steps of implicit Euler come to rest soon.
  scene.frame_rate = 10;
  scene.substeps = 1;
  SceneCloth& strip = scene.cloths[0];
  strip.self_collision = false;
  strip.material = {.stretch = {500, 50}, .shear = 1, .bending = 1e-6};
  for (int k = 0; k <= 128; ++k)
    strip.pins.push_back(ScenePin(NearestPin{left + (k / 128.0) * (right - left)}));
  Simulation simulation(scene, "scene", 1);
  const auto lowest = [&] {
    const Planes3& p = simulation.cloths()[0].state.position;
    double low = p.at(0).y;
    for (int s = 0; s < p.size() * p.size(); ++s) low = std::min(low, double{p.at(s).y});
    return low;
  };
  const double start = lowest();
  for (int frame = 0; frame < 60; ++frame) simulation.advance();
  return start - lowest();
}

/// Of a hanging strip of 1 m, times its stiffness. [N]
constexpr double by_weight = Material{}.density * 9.81 / 2;

/// A panel of 20 x 100 cm that hangs from a height of 2 m, cut along the grain or across it.
double sink_of_panel(bool across) {
  const test::TemporaryFolder folder;
  const std::string path = (folder / "strip.json").string();
  const std::string corners =
      across ? "[[0,0],[100,0],[100,20],[0,20]]" : "[[0,0],[20,0],[20,100],[0,100]]";
  const std::string place = across ? R"("translation":[20,100,0],"rotation":[0,0,90])"
                                   : R"("translation":[0,100,0],"rotation":[0,0,0])";
  write_file(path, [&](std::ostream& out) {
    out << R"({"pattern":{"panels":{"strip":{"vertices":)" << corners
        << R"(,"edges":[{"endpoints":[0,1]},{"endpoints":[1,2]},{"endpoints":[2,3]},{"endpoints":[3,0]}],)"
        << place << R"(}},"stitches":[]},"properties":{"units_in_meter":100}})";
  });
  Scene scene;
  scene.cloths.emplace_back();
  scene.cloths[0].surface = path;
  scene.cloths[0].spacing = 0.05;
  return sink_of(scene, {0, 2, 0}, {0.2, 2, 0});
}

TEST(Grain, PanelsSinkByTheStiffnessAlongTheirLength) {
  EXPECT_NEAR(sink_of_panel(false), by_weight / 500, 0.03 * by_weight / 500);
  EXPECT_NEAR(sink_of_panel(true), by_weight / 50, 0.03 * by_weight / 50);
}

Vec2f quarter_turn(Vec2f p) { return {p.y, 1 - p.x}; }

TEST(Grain, MeshesTakeItFromTheirTexture) {
  // x is across the strip: the warp lies across, or after a quarter turn along it. The image's
  // rows do not quite lie along either.
  const auto sink = [](Flat texture, bool flat_rest) {
    Scene scene = worn(halves(texture, texture), {1.0});
    if (!flat_rest) scene.cloths[0].rest.reset();
    scene.cloths[0].size = 17;
    scene.cloths[0].placement.rotate = {90, 0, 0};  // z down
    return sink_of(scene, {0, 0, 1}, {1, 0, 1});
  };
  for (const bool flat : {true, false}) {
    EXPECT_NEAR(sink(same, flat), by_weight / 50, 0.15 * by_weight / 50) << flat;
    EXPECT_LT(sink(quarter_turn, flat), 0.2 * by_weight / 50) << flat;
  }
}

}  // namespace
}  // namespace weft
