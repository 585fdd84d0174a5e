#include "weft/scene_file.h"

#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/sim/scene_texts.h"
#include "tests/support/temporary_folder.h"
#include "weft/core/json.h"
#include "weft/error.h"
#include "weft/fabric.h"
#include "weft/files.h"

namespace weft {
namespace {

using test::error_of;
using test::with_cloth;

TEST(SceneFile, EmptyClothIsTheDefaults) {
  const Scene scene = parse_scene(R"({"cloths":[{}]})", "s.json", "");
  const Scene defaults;
  EXPECT_EQ(scene.gravity, defaults.gravity);
  EXPECT_EQ(scene.frame_rate, 60);
  EXPECT_EQ(scene.substeps, 4);
  EXPECT_EQ(scene.ground, 0.0);
  EXPECT_TRUE(std::holds_alternative<NewtonOptions>(scene.integrator));
  ASSERT_EQ(scene.cloths.size(), 1);
  EXPECT_EQ(scene.cloths[0].surface, "builtin:sheet");
  EXPECT_EQ(scene.cloths[0].size, 257);
}

TEST(SceneFile, EveryKeyIsRead) {
  const Scene scene = parse_scene(R"({
    "version": 1, "gravity": [0, -1.6, 0], "frame_rate": 25, "substeps": 3, "frames": 7, "ground": null,
    "wind": {"velocity": [1, 0, 2], "drag": 0.5, "lift": 0}, "air_damping": 1.5,
    "integrator": {"type": "two_level", "local_size": 7, "global_size": 9, "as_printed": true,
                   "filter_stiffness": 12, "limiter_passes": 3},
    "collider": {"type": "pyramid"},
    "cloths": [{"name": "a", "surface": "builtin:torus", "size": 33, "scale": [1, 2, 3], "rotate": [10, 20, 30],
                "translate": [1, 0, -1], "material": {"density": 0.3, "stretch": 5, "shear": 6, "bending": 2e-5,
                "bend_springs": 7, "damping": 8, "strain_limit": 0.1, "thickness": 0.003},
                "self_collision": false, "friction": 0.1, "velocity": [3, 2, 1],
                "attach": [{"body": "b", "region": [[0, 0], [1, 0]]}],
                "pins": [{"image": [0, 1], "path": [{"time": 0}, {"time": 2, "rotate": [0, 90, 0], "translate": [1, 0, 0]}]}, {"nearest": [1, 2, 3]}, {"region": [[0, 0], [1, 0.5]]}]}],
    "bodies": [{"name": "b", "surface": "builtin:sphere", "size": 65, "scale": 2, "friction": 0.7,
                "motion": [{"time": 1}, {"time": 2, "rotate": [1, 2, 3], "translate": [4, 5, 6]}], "wait": 2, "lead_in": 0.5},
               {"name": "c", "surface": "c.obj", "animation": "c.MDD"}]})",
                                  "s.json", "");
  EXPECT_EQ(scene.gravity, (Vec3d{0, -1.6, 0}));
  EXPECT_EQ(scene.frames, 7);
  EXPECT_FALSE(scene.ground.has_value());
  ASSERT_TRUE(scene.wind.has_value());
  EXPECT_EQ(scene.wind->velocity, (Vec3d{1, 0, 2}));
  EXPECT_EQ(scene.wind->drag, 0.5);
  EXPECT_EQ(scene.wind->lift, 0);
  EXPECT_EQ(scene.air_damping, 1.5);
  const auto& two_level = std::get<TwoLevelOptions>(scene.integrator);
  EXPECT_EQ(two_level.local_size, 7);
  EXPECT_EQ(two_level.global_size, 9);
  EXPECT_TRUE(two_level.as_printed);
  EXPECT_EQ(two_level.filter_stiffness, 12);
  EXPECT_EQ(scene.limiter_passes, 3);
  EXPECT_TRUE(std::holds_alternative<PyramidOptions>(scene.collider));
  const SceneCloth& cloth = scene.cloths.at(0);
  EXPECT_EQ(cloth.placement.scale, (Vec3d{1, 2, 3}));
  EXPECT_EQ(cloth.placement.rotate, (Vec3d{10, 20, 30}));
  EXPECT_EQ(cloth.material.bending, 2e-5);
  EXPECT_EQ(cloth.material.bend_springs, 7);
  EXPECT_EQ(cloth.velocity, (Vec3d{3, 2, 1}));
  ASSERT_EQ(cloth.pins.size(), 3);
  EXPECT_EQ(std::get<ImagePin>(cloth.pins[0].place).uv, (Vec2d{0, 1}));
  EXPECT_EQ(std::get<NearestPin>(cloth.pins[1].place).point, (Vec3d{1, 2, 3}));
  EXPECT_EQ(std::get<RegionPin>(cloth.pins[2].place).upper, (Vec2d{1, 0.5}));
  ASSERT_EQ(cloth.pins[0].path.size(), 2);
  EXPECT_EQ(cloth.pins[0].path[1].time, 2);
  EXPECT_EQ(cloth.pins[0].path[1].rotate, (Vec3d{0, 90, 0}));
  EXPECT_EQ(cloth.pins[0].path[1].translate, (Vec3d{1, 0, 0}));
  EXPECT_EQ(cloth.self_collision, false);
  ASSERT_EQ(cloth.attach.size(), 1);
  EXPECT_EQ(cloth.attach[0].body, "b");
  EXPECT_EQ(std::get<RegionPin>(cloth.attach[0].place).upper, (Vec2d{1, 0}));
  EXPECT_EQ(scene.bodies.at(0).placement.scale, (Vec3d{2, 2, 2}));
  ASSERT_EQ(scene.bodies[0].motion.size(), 2);
  EXPECT_EQ(scene.bodies[0].motion[1].rotate, (Vec3d{1, 2, 3}));
  EXPECT_EQ(scene.bodies[0].wait, 2);
  EXPECT_EQ(scene.bodies[0].lead_in, 0.5);
  EXPECT_TRUE(scene.bodies.at(1).animation.name.ends_with("/c.MDD"));
}

TEST(SceneFile, AnimationsAreFilesOrNamesInThem) {
  const auto read = [](const std::string& surface, const std::string& animation) {
    const Scene scene = parse_scene(R"({"cloths":[{}],"bodies":[{"surface":")" + surface +
                                        R"(","animation":")" + animation + R"("}]})",
                                    "s.json", "/folder");
    const Scene back = parse_scene(scene_text(scene, "/folder/s.json"), "s.json", "/folder");
    EXPECT_EQ(back.bodies.at(0).animation.name, scene.bodies.at(0).animation.name);
    EXPECT_EQ(back.bodies.at(0).animation.clip, scene.bodies.at(0).animation.clip);
    return std::pair(scene.bodies.at(0).animation.name, scene.bodies.at(0).animation.clip);
  };
  using Names = std::pair<std::string, std::string>;
  EXPECT_EQ(read("a.glb", "walk"), Names("/folder/a.glb", "walk"));
  EXPECT_EQ(read("a.gltf", "Take #2"), Names("/folder/a.gltf", "Take #2"));
  EXPECT_EQ(read("a.glb", "a.glb"), Names("/folder/a.glb", ""));
  EXPECT_EQ(read("a.obj", "b.GLB#run"), Names("/folder/b.GLB", "run"));
  EXPECT_EQ(read("a.obj", "m/b.npz"), Names("/folder/m/b.npz", ""));
  EXPECT_EQ(read("a.obj", "m/b_%04d.obj"), Names("/folder/m/b_%04d.obj", ""));
}

TEST(SceneFile, PolarMapsKeysAreReadAndWritten) {
  const Scene scene = parse_scene(
      R"({"collider":{"type":"polar_map","size":99,"walk":false},"cloths":[{}]})", "s.json", "");
  const Scene back = parse_scene(scene_text(scene, "s.json"), "s.json", "");
  for (const Scene& one : {scene, back}) {
    const auto& polar_map = std::get<PolarMapOptions>(one.collider);
    EXPECT_EQ(polar_map.size, 99);
    EXPECT_FALSE(polar_map.walk);
  }
  EXPECT_EQ(back.cloths[0].self_collision, false);
}

TEST(SceneFile, NamedMaterialsAreTakenWhole) {
  for (const NamedMaterial& named : named_materials()) {
    const Scene scene =
        parse_scene(with_cloth("\"material\":\"" + std::string(named.name) + "\""), "s.json", "");
    EXPECT_EQ(scene.cloths[0].material.density, named.material.density);
    EXPECT_GT(named.material.density, 0);
  }
}

TEST(SceneFile, WarpAndWeftAreTwoNumbersOrOne) {
  const auto material = [](const std::string& keys) {
    return parse_scene(with_cloth("\"material\":{" + keys + "}"), "s.json", "").cloths[0].material;
  };
  EXPECT_EQ(material(R"("stretch":[30000,15000])").stretch, WarpWeft(30000, 15000));
  EXPECT_EQ(material(R"("bending":[2e-5,1e-5])").bending, WarpWeft(2e-5, 1e-5));
  EXPECT_EQ(material(R"("stretch":7000,"bending":3e-6)").stretch, WarpWeft(7000, 7000));
  EXPECT_EQ(material(R"("stretch":7000)").bending, Material{}.bending);
}

TEST(SceneFile, RestIsTheMeshOrItsTexture) {
  const auto rest = [](const std::string& keys) {
    return parse_scene(with_cloth(keys), "s.json", "").cloths[0].rest;
  };
  EXPECT_FALSE(rest(""));
  EXPECT_FALSE(rest(R"("rest":"mesh")"));
  EXPECT_EQ(rest(R"("rest":"uv")").value().scale, std::nullopt);
  EXPECT_EQ(rest(R"("rest":"uv","uv_scale":"auto")").value().scale, std::nullopt);
  EXPECT_EQ(rest(R"("rest":"uv","uv_scale":0.5)").value().scale, 0.5);
  EXPECT_NE(error_of(with_cloth(R"("rest":"flat")")).find("mesh or uv is wanted"),
            std::string::npos);
  EXPECT_NE(error_of(with_cloth(R"("rest":"uv","uv_scale":0)")).find("uv_scale"),
            std::string::npos);
  EXPECT_NE(error_of(with_cloth(R"("rest":"uv","uv_scale":"large")")).find("'large'"),
            std::string::npos);
  EXPECT_NE(error_of(with_cloth(R"("uv_scale":2)")).find("scales nothing"), std::string::npos);
  EXPECT_NE(error_of(with_cloth(R"("layer":2)")).find("layer: is of no garment"),
            std::string::npos);
  // Written and read again.
  for (const char* keys : {R"("rest":"uv")", R"("rest":"uv","uv_scale":0.25)"}) {
    const Scene scene = parse_scene(with_cloth(keys), "s.json", "");
    const Scene again = parse_scene(scene_text(scene, "s.json"), "s.json", "");
    EXPECT_EQ(again.cloths[0].rest.value().scale, scene.cloths[0].rest->scale);
  }
}

TEST(SceneFile, LayerIsACountOrTheOrderOfTheScene) {
  EXPECT_EQ(parse_scene(with_cloth(""), "s.json", "").cloths[0].layer, std::nullopt);
  const Scene scene = parse_scene(with_cloth(R"("surface":"tee.json","layer":3)"), "s.json", "");
  EXPECT_EQ(scene.cloths[0].layer, 3);
  EXPECT_EQ(parse_scene(scene_text(scene, "s.json"), "s.json", "").cloths[0].layer, 3);
  EXPECT_NE(error_of(with_cloth(R"("surface":"tee.json","layer":-1)")).find("layer"),
            std::string::npos);
}

TEST(SceneFile, WriterTellsWarpAndWeftApartOnlyWhereTheyDiffer) {
  const nlohmann::json material =
      parse_json(material_text({.stretch = {3e4, 15e3}, .bending = 2e-5}), 32);
  EXPECT_EQ(material["stretch"], (nlohmann::json{3e4, 15e3}));
  EXPECT_EQ(material["bending"], 2e-5);
}

TEST(SceneFile, RelativeSurfacesAreTakenFromTheScenesFolder) {
  const Scene scene =
      parse_scene(R"({"cloths":[{"surface":"../m/a.obj"}]})", "s.json", "/data/scenes");
  EXPECT_EQ(scene.cloths[0].surface, "/data/m/a.obj");
}

TEST(SceneFile, LimiterPassesAreAKeyOfMethodsThatHaveALimiter) {
  for (const char* type : {"explicit", "desbrun", "two_level", "multigrid"}) {
    const std::string text =
        fmt::format(R"({{"cloths":[{{}}],"integrator":{{"type":"{}","limiter_passes":7}}}})", type);
    EXPECT_EQ(parse_scene(text, "s.json", "").limiter_passes, 7) << type;
  }
  EXPECT_NE(error_of(R"({"cloths":[{}],"integrator":{"type":"implicit","limiter_passes":7}})")
                .find("s.json:integrator.limiter_passes: unknown key"),
            std::string::npos);
  // Nor is it written there.
  Scene scene;
  scene.cloths.resize(1);
  scene.integrator = ImplicitOptions{};
  scene.limiter_passes = 7;
  EXPECT_EQ(scene_text(scene, "s.json").find("limiter_passes"), std::string::npos);
}

TEST(SceneFile, WrittenSceneReadsBackTheSame) {
  Scene scene;
  scene.gravity = {0.1, -9.7, 1.0 / 3};
  scene.substeps = 9;
  scene.ground.reset();
  scene.integrator = TwoLevelOptions{
      .local_size = 5, .global_size = 3, .as_printed = true, .filter_stiffness = 0.7};
  scene.limiter_passes = 4;
  scene.wind = WindOptions{{}, 2, 0.25};
  SceneCloth cloth;
  const test::TemporaryFolder folder;
  cloth.surface = (folder / "mesh.obj").string();
  cloth.placement = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  cloth.material.density = 0.123;
  cloth.material.stretch = {2e4, 1e4};
  cloth.material.bending = {2e-5, 1e-5};
  cloth.velocity = {1, 2, 3};
  cloth.pins = {ImagePin{{0, 1}}, NearestPin{{1, 2, 3}}, RegionPin{{0, 0.25}, {0.5, 1}}};
  cloth.pins[1].path = {{0.5, {0, 0, 10}, {1, 2, 3}}, {1.5, {}, {4, 5, 6}}};
  scene.cloths = {cloth};
  scene.cloths[0].attach = {{"b", ImagePin{{1, 0.5}}}};
  SceneBody body;
  body.name = "b";
  body.surface = "builtin:sphere";
  body.size = 65;
  body.friction = 0.2;
  body.motion = {{0.25, {}, {1, 2, 3}}, {2, {0, 90, 0}, {}}};
  body.wait = 1.25;
  body.lead_in = 0.125;
  scene.bodies.push_back(body);
  body.name = "c";
  body.motion.clear();
  body.animation = (folder / "mesh.pc2").string();
  scene.bodies.push_back(body);

  const std::string first = (folder / "first.json").string();
  const std::string second = (folder / "second.json").string();
  write_scene(first, scene);
  const Scene back = read_scene(first);
  EXPECT_EQ(back.gravity, scene.gravity);
  EXPECT_EQ(back.cloths[0].surface, cloth.surface);
  EXPECT_EQ(back.cloths[0].placement.rotate, cloth.placement.rotate);
  EXPECT_EQ(back.cloths[0].material.density, 0.123);
  EXPECT_EQ(back.cloths[0].material.stretch, WarpWeft(2e4, 1e4));
  EXPECT_EQ(back.cloths[0].material.bending, WarpWeft(2e-5, 1e-5));
  EXPECT_EQ(std::get<TwoLevelOptions>(back.integrator).filter_stiffness, 0.7);
  EXPECT_EQ(std::get<RegionPin>(back.cloths[0].pins[2].place).lower, (Vec2d{0, 0.25}));
  EXPECT_EQ(back.cloths[0].pins[1].path.at(1).translate, (Vec3d{4, 5, 6}));
  EXPECT_EQ(back.cloths[0].attach.at(0).body, "b");
  EXPECT_EQ(back.bodies.at(0).motion.at(1).rotate, (Vec3d{0, 90, 0}));
  EXPECT_EQ(back.bodies.at(0).wait, 1.25);
  EXPECT_EQ(back.bodies.at(0).lead_in, 0.125);
  EXPECT_EQ(back.bodies.at(1).animation.name, body.animation.name);
  ASSERT_TRUE(back.wind.has_value());
  EXPECT_EQ(back.wind->lift, 0.25);
  EXPECT_FALSE(back.ground.has_value());
  write_scene(second, back);
  const auto text = [](const std::string& path) { return parse_json(read_file(path), 32); };
  EXPECT_EQ(text(first), text(second));
}

}  // namespace
}  // namespace weft
