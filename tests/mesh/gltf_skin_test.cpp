// Skins and morph targets of glTF files.
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "tests/mesh/moving_pair.h"
#include "weft/mesh.h"

namespace weft {
namespace {

using test::expect_near;
using test::half;
using test::MovingPair;
using Json = nlohmann::json;
using Floats = std::vector<float>;

TEST(GltfMotion, SkinsBlendTheirJointsLinearly) {
  MovingPair file;
  file.skin({1, 0, 0.25F, 1, 1, 1}, {0, 1, 0.75F, 0, 0, 0});
  file.move(1, "translation", {0, 1}, {0, 0, 0, 2, 0, 0}, 3);
  file.move(2, "translation", {0, 1}, {0, 0, 0, 0, 0, 8}, 3);
  expect_near(file.at(1, 0), {2, 0, 0});
  expect_near(file.at(1, 1), {1, 0, 8});
  expect_near(file.at(1, 2), {0.5, 1, 6});
}

TEST(GltfMotion, PrimitivesThatShareTheirPositionsHaveJointsOfTheirOwn) {
  MovingPair file;
  file.skin({1, 1, 1, 1, 1, 1}, {0, 0, 0, 0, 0, 0});  // all go with the first joint
  Json& primitives = file.pair.json["meshes"][0]["primitives"];
  Json second = primitives[0];
  Floats weights;
  for (int v = 0; v < 6; ++v) weights.insert(weights.end(), {0, 1, 0, 0});
  second["attributes"]["WEIGHTS_0"] = file.add(weights, "VEC4", 5126, 4);
  // The first triangle is of one primitive, the second of the other.
  primitives[0]["indices"] = file.add(std::vector<std::uint16_t>{0, 1, 2}, "SCALAR", 5123, 1);
  second["indices"] = file.add(std::vector<std::uint16_t>{3, 4, 5}, "SCALAR", 5123, 1);
  primitives.push_back(second);
  file.move(2, "translation", {0}, {0, 0, 7}, 3);
  EXPECT_EQ(file.rig().points(), 4);
  expect_near(file.at(0, 0), {0, 0, 0});
  expect_near(file.at(0, 1), {1, 0, 0});
  expect_near(file.at(0, 3), {1, 1, 7});  // of the second alone
}

TEST(GltfMotion, PrimitivesThatShareTheirPositionsHaveTargetsOfTheirOwn) {
  MovingPair file;
  Json& primitives = file.pair.json["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  Floats offsets(18, 0);
  primitives[0]["targets"] = {{{"POSITION", file.vectors(offsets)}}};
  for (std::size_t v = 0; v < 6; ++v) offsets[3 * v + 2] = 5;
  primitives[1]["targets"] = {{{"POSITION", file.vectors(offsets)}}};
  primitives[0]["indices"] = file.add(std::vector<std::uint16_t>{0, 1, 2}, "SCALAR", 5123, 1);
  primitives[1]["indices"] = file.add(std::vector<std::uint16_t>{3, 4, 5}, "SCALAR", 5123, 1);
  file.move(0, "weights", {0}, {1}, 1);
  expect_near(file.at(0, 0), {0, 0, 0});
  expect_near(file.at(0, 3), {1, 1, 5});
}

TEST(GltfMotion, JointsTurnAboutWhereTheyAreBound) {
  MovingPair file;
  file.skin({0, 0, 0, 0, 0, 0}, {1, 1, 1, 1, 1, 1});
  Floats binds{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const Floats second{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1};  // bound at (1, 0, 0)
  binds.insert(binds.end(), second.begin(), second.end());
  file.pair.json["skins"][0]["inverseBindMatrices"] = file.add(binds, "MAT4", 5126, 16);
  file.pair.json["nodes"][2]["translation"] = {1, 0, 0};
  file.move(2, "rotation", {0, 1},
            {0, 0, 0, 1, 0, 0, static_cast<float>(half), static_cast<float>(half)}, 4);
  expect_near(file.at(0, 0), {0, 0, 0});
  expect_near(file.at(1, 1), {1, 0, 0}, 1e-7);
  expect_near(file.at(1, 0), {1, -1, 0}, 1e-7);
}

TEST(GltfMotion, TheNodeOfASkinnedMeshDoesNotMoveIt) {
  MovingPair file;
  file.skin({1, 1, 1, 1, 1, 1}, {0, 0, 0, 0, 0, 0});
  file.pair.json["nodes"][0]["translation"] = {5, 5, 5};
  file.move(1, "translation", {0}, {0, 1, 0}, 3);
  expect_near(file.at(0), {0, 1, 0});
}

TEST(GltfMotion, MeshesWithASkinStandWhereItIsBound) {
  MovingPair file;
  file.skin({1, 1, 1, 1, 1, 1}, {0, 0, 0, 0, 0, 0});
  // As programs write it that keep centimetres: vertices a hundred times as large as the skeleton.
  Floats binds;
  for (int joint = 0; joint < 2; ++joint)
    for (int k = 0; k < 16; ++k) binds.push_back(k % 5 != 0 ? 0.0F : k == 15 ? 1.0F : 0.01F);
  file.pair.json["skins"][0]["inverseBindMatrices"] = file.add(binds, "MAT4", 5126, 16);
  for (const int joint : {1, 2}) file.pair.json["nodes"][joint]["translation"] = {0, 2, 0};
  const auto rest = [&] { return parse_gltf(file.pair.bytes(), "a.glb").positions; };
  expect_near(rest().at(1), {0.01, 2, 0}, 1e-9);
  file.move(1, "translation", {0}, {0, 2, 0}, 3);
  expect_near(file.at(0, 1), {0.01, 2, 0}, 1e-9);
  // A skeleton that was saved in a pose leaves the mesh to its node, and so does a skin that cannot
  // be read.
  file.pair.json["nodes"][2]["translation"] = {0, 3, 0};
  EXPECT_EQ(rest().at(1), (Vec3d{1, 0, 0}));
  file.pair.json["skins"][0]["joints"] = {1, 99};
  EXPECT_EQ(rest().at(1), (Vec3d{1, 0, 0}));
}

TEST(GltfMotion, WeightsAreMadeToAddUpToOne) {
  MovingPair file;
  file.skin({3, 0, 1, 1, 1, 1}, {1, 0, 0, 0, 0, 0});  // the second vertex has none at all
  file.move(1, "translation", {0}, {4, 0, 0}, 3);
  expect_near(file.at(0, 0), {3, 0, 0});
  expect_near(file.at(0, 1), {5, 0, 0});  // goes with its first joint
}

TEST(GltfMotion, WholeNumbersAreWeightsWhenNormalized) {
  MovingPair file;
  file.skin({1, 1, 1, 1, 1, 1}, {0, 0, 0, 0, 0, 0});
  std::vector<std::uint16_t> weights;
  for (int v = 0; v < 6; ++v) weights.insert(weights.end(), {13107, 52428, 0, 0});  // 0.2 and 0.8
  const int index = file.add(weights, "VEC4", 5123, 4);
  file.pair.json["accessors"][index]["normalized"] = true;
  file.pair.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = index;
  file.move(1, "translation", {0}, {10, 0, 0}, 3);
  expect_near(file.at(0), {2, 0, 0});
}

TEST(GltfMotion, EightJointsAVertexAreAllFelt) {
  MovingPair file;
  file.skin({1, 1, 1, 1, 1, 1}, {0, 0, 0, 0, 0, 0});
  Json& attributes = file.pair.json["meshes"][0]["primitives"][0]["attributes"];
  std::vector<std::uint8_t> joints;
  Floats weights;
  for (int v = 0; v < 6; ++v) {
    joints.insert(joints.end(), {1, 0, 0, 0});
    weights.insert(weights.end(), {3, 0, 0, 0});
  }
  attributes["JOINTS_1"] = file.add(joints, "VEC4", 5121, 4);
  attributes["WEIGHTS_1"] = file.add(weights, "VEC4", 5126, 4);
  file.move(2, "translation", {0}, {4, 0, 0}, 3);
  expect_near(file.at(0), {3, 0, 0});
}

TEST(GltfMotion, MorphTargetsAddByTheirWeights) {
  MovingPair file = test::morphing();
  file.move(0, "weights", {0, 1}, {0, 0.5F, 1, 0}, 1);
  expect_near(file.at(0), {0, 1, 0});
  expect_near(file.at(0.5), {0.5, 0.5, 0});
  expect_near(file.at(1), {1, 0, 0});
}

TEST(GltfMotion, WeightsThatNothingMovesAreThoseOfNodeOrMesh) {
  MovingPair file = test::morphing();
  file.move(0, "translation", {0}, {0, 0, 7}, 3);
  expect_near(file.at(0), {0, 0, 7});
  file.pair.json["meshes"][0]["weights"] = {0, 1};
  expect_near(file.at(0), {0, 2, 7});
  file.pair.json["nodes"][0]["weights"] = {1, 0};
  expect_near(file.at(0), {1, 0, 7});
}

TEST(GltfMotion, MorphedPointsAreSkinnedAfterwards) {
  MovingPair file = test::morphing();
  file.skin({1, 1, 1, 1, 1, 1}, {0, 0, 0, 0, 0, 0});
  file.pair.json["meshes"][0]["weights"] = {1, 0};
  file.move(1, "rotation", {0}, {0, 0, static_cast<float>(half), static_cast<float>(half)}, 4);
  expect_near(file.at(0), {0, 1, 0}, 1e-7);
}

TEST(GltfMotion, SparseAccessorsChangeSomeElements) {
  MovingPair file;
  const std::vector<std::uint16_t> places{1, 3};
  const Floats moved{0, 0, 3, 0, 0, 3};
  const int indices = file.add(places, "SCALAR", 5123, 1), values = file.vectors(moved);
  Json& json = file.pair.json;
  const auto view = [&](int accessor) { return json["accessors"][accessor]["bufferView"]; };
  json["accessors"].push_back(
      {{"componentType", 5126},
       {"count", 6},
       {"type", "VEC3"},
       {"sparse",
        {{"count", 2},
         {"indices", {{"bufferView", view(indices)}, {"componentType", 5123}}},
         {"values", {{"bufferView", view(values)}}}}}});
  const std::size_t sparse = json["accessors"].size() - 1;
  json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", sparse}}};
  file.move(0, "weights", {0}, {1}, 1);
  expect_near(file.at(0, 0), {0, 0, 0});
  expect_near(file.at(0, 1), {1, 0, 3});
  json["accessors"][sparse]["count"] = 2;
  EXPECT_EQ(file.refusal(),
            "a.glb: accessors[4].sparse.indices names number 3 of 2; an existing one, counted from "
            "0, is wanted");
  json["accessors"][sparse]["count"] = 2'000'000'000;
  EXPECT_EQ(file.refusal(),
            "a.glb: accessors[4].count is '2000000000'; a whole number from 1 to 700000000 is "
            "wanted");
  json["accessors"][sparse]["count"] = 600'000'000;
  EXPECT_EQ(file.refusal(),
            "a.glb: accessors[4] has 600000000 elements in no buffer; at most 4000000 are wanted");
}

}  // namespace
}  // namespace weft
