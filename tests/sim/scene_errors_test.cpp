// What is wrong with scene files, and what is said of it.
#include <gtest/gtest.h>

#include "tests/sim/scene_texts.h"
#include "tests/support/temporary_folder.h"
#include "weft/error.h"
#include "weft/files.h"
#include "weft/scene_file.h"

namespace weft {
namespace {

using test::error_of;
using test::with_cloth;

TEST(SceneFile, UnknownKeyNamesItsPathAndTheNearestKey) {
  EXPECT_EQ(error_of(with_cloth(R"("materail":"cotton")")),
            "s.json:cloths[0].materail: unknown key; the nearest known key is 'material'");
  EXPECT_EQ(error_of(R"({"cloths":[{}],"bodies":[{"surface":"x","frictoin":1}]})"),
            "s.json:bodies[0].frictoin: unknown key; the nearest known key is 'friction'");
  EXPECT_EQ(error_of(with_cloth(R"("material":{"densty":1})")),
            "s.json:cloths[0].material.densty: unknown key; the nearest known key is 'density'");
}

TEST(SceneFile, WrongTypesAndRangesNameTheKey) {
  EXPECT_EQ(error_of(R"({"cloths":[{}],"frame_rate":0})"),
            "s.json:frame_rate: 0; a number > 0 is wanted");
  EXPECT_EQ(error_of(R"({"cloths":[{}],"substeps":0})"),
            "s.json:substeps: 0; a whole number from 1 to 10000 is wanted");
  EXPECT_EQ(error_of(R"({"cloths":[{}],"substeps":1.5})"),
            "s.json:substeps: 1.5; a whole number from 1 to 10000 is wanted");
  EXPECT_EQ(error_of(with_cloth(R"("size":4)")),
            "s.json:cloths[0].size: 4; a whole number from 5 to 8193 is wanted");
  EXPECT_EQ(error_of(with_cloth(R"("material":{"stretch":-1})")),
            "s.json:cloths[0].material.stretch: -1; a number >= 0 is wanted");
  for (const std::string wrong : {"[1]", "[1,2,3]", "[]", R"([1,"2"])", "[1,-2]"})
    for (const std::string key : {"stretch", "bending"})
      EXPECT_EQ(error_of(with_cloth(R"("material":{")" + key + "\":" + wrong + "}")),
                "s.json:cloths[0].material." + key + ": " + wrong +
                    "; two numbers >= 0, [warp, weft], or one are wanted");
  EXPECT_EQ(error_of(with_cloth(R"("material":{"bending":"much"})")),
            "s.json:cloths[0].material.bending: \"much\"; a number >= 0 is wanted");
  EXPECT_EQ(error_of(with_cloth(R"("material":{"shear":[1,2]})")),
            "s.json:cloths[0].material.shear: [1,2]; a number >= 0 is wanted");
  EXPECT_EQ(error_of(with_cloth(R"("translate":[0,1])")),
            "s.json:cloths[0].translate: [0,1]; a list of 3 finite numbers is wanted");
  EXPECT_EQ(error_of(with_cloth(R"("friction":"much")")),
            "s.json:cloths[0].friction: \"much\"; a number from 0 to 10 is wanted");
  EXPECT_EQ(error_of(with_cloth(R"("pins":[{"image":[0,2]}])")),
            "s.json:cloths[0].pins[0].image: [0, 2]; u and v from 0 to 1 are wanted");
  EXPECT_EQ(error_of(with_cloth(R"("pins":[{"image":[0,1],"path":[{"time":1},{"time":1}]}])")),
            "s.json:cloths[0].pins[0].path[1].time: 1 after 1; ascending times are wanted");
  EXPECT_EQ(error_of(R"({"cloths":[{}],"wind":{"drag":-1}})"),
            "s.json:wind.drag: -1; a number >= 0 is wanted");
  EXPECT_EQ(error_of(R"({"cloths":[{}],"air_damping":-1})"),
            "s.json:air_damping: -1; a number >= 0 is wanted");
  EXPECT_EQ(error_of(R"({"cloths":[]})"), "s.json:cloths: no cloth; at least one is wanted");
  EXPECT_EQ(error_of(R"([1])"), "s.json: [1] is no object; an object {...} is wanted");
}

TEST(SceneFile, WhatIsNotJsonNamesTheLine) {
  EXPECT_EQ(error_of("{\n\"cloths\": [{}],\n oops }"),
            "s.json:3: is not JSON here; a scene file is wanted");
  EXPECT_EQ(error_of(""), "s.json:1: is not JSON here; a scene file is wanted");
  EXPECT_EQ(error_of("{\"gravity\":\n" + std::string(1000000, '[')),
            "s.json:2: JSON nested more than 32 deep; a scene file is wanted");
}

TEST(SceneFile, UnknownNamesListWhatIsKnown) {
  EXPECT_EQ(error_of(R"({"cloths":[{}],"integrator":{"type":"midpoint"}})"),
            "s.json:integrator.type: unknown integrator 'midpoint'; known are: newton, implicit, "
            "explicit, desbrun, two_level, multigrid");
  EXPECT_EQ(error_of(R"({"cloths":[{}],"collider":{"type":"octree"}})"),
            "s.json:collider.type: unknown collider 'octree'; known are: pyramid, polar_map, "
            "sphere_tree, spatial_hash, image_space");
  EXPECT_EQ(error_of(with_cloth(R"("material":"coton")")),
            "s.json:cloths[0].material: unknown material 'coton'; the nearest known is 'cotton'");
  EXPECT_EQ(error_of(R"({"cloths":[{}],"version":2})"),
            "s.json:version: unknown version; 1 is wanted");
}

TEST(SceneFile, MotionsThatMakeNoSenseAreRefused) {
  const auto error_with = [](const std::string& keys) {
    return error_of(R"({"cloths":[{}],"bodies":[{"surface":"builtin:rod",)" + keys + "}]}");
  };
  EXPECT_EQ(error_with(R"("motion":[{"time":1},{"time":0}])"),
            "s.json:bodies[0].motion[1].time: 0 after 1; ascending times are wanted");
  EXPECT_EQ(
      error_with(R"("animation":"a.abc")"),
      "s.json:bodies[0].animation: 'a.abc'; a motion, .pc2, .mdd, .npz, .glb, .gltf or numbered "
      "meshes (body_%04d.obj), is wanted");
  EXPECT_EQ(error_with(R"("motion":[{"time":0}],"animation":"a.pc2")"),
            "s.json:bodies[0].animation: is there beside motion; one of both is wanted");
  EXPECT_EQ(error_with(R"("lead_in":1)"),
            "s.json:bodies[0].lead_in: leads to nothing; motion or animation beside it is wanted");
  EXPECT_EQ(error_with(R"("wait":1)"),
            "s.json:bodies[0].wait: leads to nothing; motion or animation beside it is wanted");
  EXPECT_EQ(error_with(R"("motion":[{"time":0}],"lead_in":-1)"),
            "s.json:bodies[0].lead_in: -1; a number >= 0 is wanted");
}

TEST(SceneFile, AttachmentsNameABodyOfTheScene) {
  const auto error_with = [](const std::string& attachment) {
    return error_of(R"({"cloths":[{"attach":[)" + attachment +
                    R"(]}],"bodies":[{"name":"figure","surface":"builtin:mannequin"}]})");
  };
  EXPECT_EQ(error_with(R"({"body":"figur","image":[0,0]})"),
            "s.json:cloths[0].attach[0].body: no body is called 'figur'; the nearest known is "
            "'figure'");
  EXPECT_EQ(error_with(R"({"image":[0,0]})"),
            "s.json:cloths[0].attach[0].body: no body; the name of a body is wanted");
  EXPECT_EQ(error_with(R"({"body":"figure"})"),
            "s.json:cloths[0].attach[0]: 0 places; one of \"image\", \"nearest\" and "
            "\"region\" is wanted");
  EXPECT_EQ(error_of(with_cloth(R"("attach":[{"body":"a","image":[0,0]}])")),
            "s.json:cloths[0].attach[0].body: no body is called 'a'; a scene with a body is "
            "wanted");
}

TEST(SceneFile, WhatAColliderLacksIsRefusedOnlyWhereItIsAskedFor) {
  EXPECT_EQ(error_of(R"({"collider":{"type":"polar_map"},"cloths":[{"self_collision":true}]})"),
            "s.json:cloths[0].self_collision: true is not available with collider polar_map; false "
            "is wanted");
  EXPECT_EQ(error_of(R"({"collider":{"type":"polar_map"},"cloths":[{}],"bodies":[
                {"surface":"builtin:rod","motion":[{"time":0}]}]})"),
            "s.json:bodies[0].motion: moving bodies are not available with collider polar_map; "
            "another collider, or bodies that stand still, are wanted");
  EXPECT_EQ(error_of(R"({"collider":{"type":"polar_map"},"cloths":[{}]})"), "");
}

TEST(SceneFile, StillAirIsNoneUnlessItsCoefficientsAreGiven) {
  EXPECT_FALSE(parse_scene(R"({"cloths":[{}],"wind":{"velocity":[0,0,0]}})", "s", "").wind);
  EXPECT_TRUE(parse_scene(R"({"cloths":[{}],"wind":{"drag":1}})", "s", "").wind);
  EXPECT_TRUE(parse_scene(R"({"cloths":[{}],"wind":{"velocity":[0,0,1]}})", "s", "").wind);
}

TEST(SceneFile, KeysThatAreThereTwiceAreRefusedWithTheirLine) {
  EXPECT_EQ(error_of("{\"cloths\":[{\"size\":9,\n\"size\":17}]}"),
            "s.json:2: the key 'size' is there twice; each key once is wanted");
}

TEST(SceneFile, NamesThatDifferInCapitalLettersOnlyAreRefused) {
  EXPECT_EQ(
      error_of(R"({"cloths":[{"name":"Sheet"}],"bodies":[{"name":"sheet","surface":"b.obj"}]})"),
      "s.json:bodies[0].name: 'sheet' differs from 'Sheet' in capital letters only; a name of "
      "its own for each cloth and body is wanted");
  EXPECT_NE(error_of(R"({"cloths":[{"name":"a.IMAGE"},{"name":"A"}]})"), "");
}

TEST(SceneFile, TwoThingsOfOneNameAreRefused) {
  EXPECT_EQ(error_of(R"({"cloths":[{"name":"a"},{"name":"a"}]})"),
            "s.json:cloths[1].name: 'a' is there twice; a name of its own for each cloth and body "
            "is wanted");
  for (const char* const taken : {"a.image", "a.panels", "a.draped"})
    EXPECT_NE(error_of(R"({"cloths":[{"name":"a"}],"bodies":[{"surface":"b.obj","name":")" +
                       std::string(taken) + R"("}]})")
                  .find("is there twice"),
              std::string::npos)
        << taken;
  EXPECT_NE(error_of(with_cloth(R"("name":"../x")")).find("files are named by it"),
            std::string::npos);
}

}  // namespace
}  // namespace weft
