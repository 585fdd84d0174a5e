#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/mesh/gltf_files.h"
#include "tests/support/errors.h"
#include "tests/support/temporary_folder.h"
#include "weft/core/json.h"
#include "weft/files.h"
#include "weft/mesh.h"
#include "weft/mesh/io/gltf_rig.h"
#include "weft/point_cache.h"

namespace weft {
namespace {

using Json = nlohmann::json;
using Floats = std::vector<float>;

const double half = 0.70710678118654752;

/// Two triangles (test::CreasedPair) shown by node 0, with one animation, 'move'.
struct Moving {
  test::CreasedPair pair;

  Moving() {
    pair.json["animations"] = {
        {{"name", "move"}, {"samplers", Json::array()}, {"channels", Json::array()}}};
  }

  /// @return number of a new accessor
  template <class Number>
  int add(const std::vector<Number>& numbers, const char* type, int component, int width) {
    Json& json = pair.json;
    json["bufferViews"].push_back({{"buffer", 0},
                                   {"byteOffset", pair.binary.size()},
                                   {"byteLength", numbers.size() * sizeof(Number)}});
    test::put(pair.binary, numbers);
    pair.binary.resize((pair.binary.size() + 3) / 4 * 4);
    json["buffers"][0]["byteLength"] = pair.binary.size();
    json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                 {"componentType", component},
                                 {"count", numbers.size() / static_cast<std::size_t>(width)},
                                 {"type", type}});
    return static_cast<int>(json["accessors"].size()) - 1;
  }
  int vectors(const Floats& numbers) { return add(numbers, "VEC3", 5126, 3); }

  /// Moves a node by keys. @param values  of so many numbers each
  void move(int node, const char* path, const Floats& times, const Floats& values, int width,
            const char* way = "LINEAR") {
    const char* type = width == 4 ? "VEC4" : width == 3 ? "VEC3" : "SCALAR";
    const int input = add(times, "SCALAR", 5126, 1), output = add(values, type, 5126, width);
    Json& animation = pair.json["animations"][0];
    animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", way}});
    animation["channels"].push_back({{"sampler", animation["samplers"].size() - 1},
                                     {"target", {{"node", node}, {"path", path}}}});
  }

  /// A skin of nodes 1 and 2, whose six vertices have these weights.
  void skin(const Floats& of_first, const Floats& of_second) {
    std::vector<std::uint8_t> joints;
    Floats weights;
    for (std::size_t v = 0; v < 6; ++v) {
      joints.insert(joints.end(), {0, 1, 0, 0});
      weights.insert(weights.end(), {of_first[v], of_second[v], 0, 0});
    }
    Json& json = pair.json;
    json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] = add(joints, "VEC4", 5121, 4);
    json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = add(weights, "VEC4", 5126, 4);
    json["nodes"][0]["skin"] = 0;
    json["nodes"].push_back(Json::object());
    json["nodes"].push_back(Json::object());
    json["scenes"][0]["nodes"] = {0, 1, 2};
    json["skins"] = {{{"joints", {1, 2}}}};
  }

  [[nodiscard]] GltfRig rig(std::string_view clip = "") const {
    return read_gltf_rig(pair.bytes(), "a.glb", clip, std::nullopt);
  }
  /// Where a vertex is. @param vertex  of the joined ones: (0,0,0), (1,0,0), (0,1,0), (1,1,0)
  [[nodiscard]] Vec3d at(double seconds, std::size_t vertex = 0) const {
    return positions_at(rig(), seconds).at(vertex);
  }
  [[nodiscard]] std::string refusal(std::string_view clip = "") const {
    return test::message_of<InputError>(
        [&] { parse_gltf_motion(pair.bytes(), "a.glb", {std::string(clip)}); });
  }
};

void expect_near(Vec3d found, Vec3d wanted, double tolerance = 1e-12) {
  EXPECT_NEAR(found.x, wanted.x, tolerance);
  EXPECT_NEAR(found.y, wanted.y, tolerance);
  EXPECT_NEAR(found.z, wanted.z, tolerance);
}

TEST(GltfMotion, LinearKeysHoldBeforeAndAfter) {
  Moving file;
  file.move(0, "translation", {1, 3}, {0, 0, 0, 4, 0, 2}, 3);
  EXPECT_EQ(file.rig().duration, 3);
  expect_near(file.at(0), {0, 0, 0});
  expect_near(file.at(1.5), {1, 0, 0.5});
  expect_near(file.at(3), {4, 0, 2});
  expect_near(file.at(9), {4, 0, 2});
}

TEST(GltfMotion, StepsStayUntilTheNextKey) {
  Moving file;
  file.move(0, "translation", {0, 1, 2}, {0, 0, 0, 1, 0, 0, 5, 0, 0}, 3, "STEP");
  EXPECT_EQ(file.at(0.999).x, 0);
  EXPECT_EQ(file.at(1).x, 1);
  EXPECT_EQ(file.at(1.999).x, 1);
  EXPECT_EQ(file.at(2).x, 5);
}

TEST(GltfMotion, CubicSplinesPassKeysWithTheirTangents) {
  Moving file;
  // In tangent, value and out tangent of each key: leaves 1 with slope 3, reaches 2 with slope -1,
  // two seconds later.
  file.move(0, "scale", {0, 2}, {9, 9, 9, 1, 1, 1, 3, 3, 3, -1, -1, -1, 2, 2, 2, 7, 7, 7}, 3,
            "CUBICSPLINE");
  const auto wanted = [](double t) {  // Hermite's polynomial over two seconds
    return (2 * t * t * t - 3 * t * t + 1) * 1 + 2 * (t * t * t - 2 * t * t + t) * 3 +
           (3 * t * t - 2 * t * t * t) * 2 + 2 * (t * t * t - t * t) * -1;
  };
  for (const double t : {0.0, 0.25, 0.5, 0.9, 1.0})
    expect_near(file.at(2 * t, 1), {wanted(t), 0, 0});
  EXPECT_NEAR((file.at(1e-6, 1).x - 1) / 1e-6, 3, 1e-4);
  EXPECT_NEAR((2 - file.at(2 - 1e-6, 1).x) / 1e-6, -1, 1e-4);
}

TEST(GltfMotion, RotationsGoEvenlyTheShorterWay) {
  const auto h = static_cast<float>(half);
  for (const float sign : {1.0F, -1.0F}) {  // the same rotation, by the other quaternion
    Moving file;
    file.move(0, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, sign * h, sign * h}, 4);
    for (const double part : {0.25, 0.5, 0.75}) {
      const double angle = part * 1.5707963267948966;
      expect_near(file.at(part, 1), {std::cos(angle), std::sin(angle), 0}, 1e-7);
    }
  }
}

TEST(GltfMotion, CubicRotationsAreMadeUnitQuaternions) {
  Moving file;
  file.move(0, "rotation", {0, 1},
            {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0}, 4,
            "CUBICSPLINE");
  expect_near(file.at(0.5, 1), {0, 1, 0}, 1e-12);  // half way between none and 180 degrees
  EXPECT_NEAR(length(file.at(0.3, 1)), 1, 1e-12);
}

TEST(GltfMotion, ChildrenGoWithTheirParents) {
  Moving file;
  file.pair.json["nodes"] = parse_json(R"([{"mesh": 0, "translation": [1, 0, 0]},
                                           {"children": [0], "scale": [2, 2, 2]}])",
                                       16);
  file.pair.json["scenes"][0]["nodes"] = {1};
  file.move(1, "translation", {0, 1}, {0, 0, 0, 0, 6, 0}, 3);
  file.move(0, "translation", {0, 1}, {1, 0, 0, 3, 0, 0}, 3);
  expect_near(file.at(0.5), {4, 3, 0});
}

TEST(GltfMotion, SkinsBlendTheirJointsLinearly) {
  Moving file;
  file.skin({1, 0, 0.25F, 1, 1, 1}, {0, 1, 0.75F, 0, 0, 0});
  file.move(1, "translation", {0, 1}, {0, 0, 0, 2, 0, 0}, 3);
  file.move(2, "translation", {0, 1}, {0, 0, 0, 0, 0, 8}, 3);
  expect_near(file.at(1, 0), {2, 0, 0});
  expect_near(file.at(1, 1), {1, 0, 8});
  expect_near(file.at(1, 2), {0.5, 1, 6});
}

TEST(GltfMotion, PrimitivesThatShareTheirPositionsHaveJointsOfTheirOwn) {
  Moving file;
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
  Moving file;
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
  Moving file;
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
  Moving file;
  file.skin({1, 1, 1, 1, 1, 1}, {0, 0, 0, 0, 0, 0});
  file.pair.json["nodes"][0]["translation"] = {5, 5, 5};
  file.move(1, "translation", {0}, {0, 1, 0}, 3);
  expect_near(file.at(0), {0, 1, 0});
}

TEST(GltfMotion, MeshesWithASkinStandWhereItIsBound) {
  Moving file;
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
  Moving file;
  file.skin({3, 0, 1, 1, 1, 1}, {1, 0, 0, 0, 0, 0});  // the second vertex has none at all
  file.move(1, "translation", {0}, {4, 0, 0}, 3);
  expect_near(file.at(0, 0), {3, 0, 0});
  expect_near(file.at(0, 1), {5, 0, 0});  // goes with its first joint
}

TEST(GltfMotion, WholeNumbersAreWeightsWhenNormalized) {
  Moving file;
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
  Moving file;
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

/// A file with two morph targets: all vertices by 1 along x, and by 2 along y.
Moving morphing() {
  Moving file;
  Floats along_x, along_y;
  for (int v = 0; v < 6; ++v) {
    along_x.insert(along_x.end(), {1, 0, 0});
    along_y.insert(along_y.end(), {0, 2, 0});
  }
  const Json first{{"POSITION", file.vectors(along_x)}},
      second{{"POSITION", file.vectors(along_y)}};
  file.pair.json["meshes"][0]["primitives"][0]["targets"] = {first, second};
  return file;
}

TEST(GltfMotion, MorphTargetsAddByTheirWeights) {
  Moving file = morphing();
  file.move(0, "weights", {0, 1}, {0, 0.5F, 1, 0}, 1);
  expect_near(file.at(0), {0, 1, 0});
  expect_near(file.at(0.5), {0.5, 0.5, 0});
  expect_near(file.at(1), {1, 0, 0});
}

TEST(GltfMotion, WeightsThatNothingMovesAreThoseOfNodeOrMesh) {
  Moving file = morphing();
  file.move(0, "translation", {0}, {0, 0, 7}, 3);
  expect_near(file.at(0), {0, 0, 7});
  file.pair.json["meshes"][0]["weights"] = {0, 1};
  expect_near(file.at(0), {0, 2, 7});
  file.pair.json["nodes"][0]["weights"] = {1, 0};
  expect_near(file.at(0), {1, 0, 7});
}

TEST(GltfMotion, MorphedPointsAreSkinnedAfterwards) {
  Moving file = morphing();
  file.skin({1, 1, 1, 1, 1, 1}, {0, 0, 0, 0, 0, 0});
  file.pair.json["meshes"][0]["weights"] = {1, 0};
  file.move(1, "rotation", {0}, {0, 0, static_cast<float>(half), static_cast<float>(half)}, 4);
  expect_near(file.at(0), {0, 1, 0}, 1e-7);
}

TEST(GltfMotion, SparseAccessorsChangeSomeElements) {
  Moving file;
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

TEST(GltfMotion, AnimationsHaveNames) {
  Moving file;
  file.move(0, "translation", {0}, {1, 0, 0}, 3);
  file.pair.json["animations"].push_back(file.pair.json["animations"][0]);
  file.pair.json["animations"][1].erase("name");
  file.pair.json["animations"][1]["samplers"][0]["output"] = file.vectors({2, 0, 0});
  EXPECT_EQ(positions_at(file.rig(), 0)[0].x, 1);
  EXPECT_EQ(positions_at(file.rig("move"), 0)[0].x, 1);
  EXPECT_EQ(positions_at(file.rig("animation_1"), 0)[0].x, 2);
  EXPECT_EQ(file.refusal("run"),
            "a.glb: has no animation 'run'; one of its 2, 'move', 'animation_1', is wanted");
  file.pair.json.erase("animations");
  EXPECT_EQ(file.refusal(), "a.glb: has no animation; a file with one is wanted");
}

TEST(GltfMotion, SamplesAreAtWholeFramesAfterTheLeadIn) {
  Moving file;
  file.move(0, "translation", {0, 1.05F}, {0, 0, 0, 2.1F, 0, 0}, 3);
  const PointCache cache = parse_gltf_motion(file.pair.bytes(), "a.glb", {"", 4, 0.6});
  EXPECT_FALSE(cache.times_in_frames);
  EXPECT_EQ(cache.points, 4);
  const std::vector<double> wanted{0, 0.15, 0.4, 0.65, 0.9, 1.05};
  ASSERT_EQ(cache.times.size(), wanted.size());
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    EXPECT_NEAR(cache.times[k], wanted[k], 1e-6);
    EXPECT_NEAR(cache.sample(static_cast<int>(k))[0].x, 2 * wanted[k], 1e-6);
  }
}

TEST(GltfMotion, EndsThatAreFramesButForRoundingAreOneSample) {
  for (const float end : {3.45F, 3.4499998F, 3.45F - 0.1F / 60}) {
    Moving file;
    file.move(0, "translation", {0, end}, {0, 0, 0, 1, 0, 0}, 3);
    const PointCache cache = parse_gltf_motion(file.pair.bytes(), "a.glb", {});
    EXPECT_EQ(cache.samples(), 208) << end;
    EXPECT_EQ(cache.times.back(), end);
    EXPECT_EQ(cache.sample(207)[0].x, 1);
  }
}

TEST(GltfMotion, FirstSampleOfAStillFileIsItsMesh) {
  Moving file;
  file.pair.json["nodes"][0] = {{"mesh", 0}, {"translation", {1, 2, 3}}, {"scale", {1, 2, 1}}};
  file.move(0, "scale", {0}, {1, 2, 1}, 3);
  const std::vector<Vec3d> mesh = parse_gltf(file.pair.bytes(), "a.glb").positions;
  EXPECT_EQ(positions_at(file.rig(), 0), mesh);
}

/// What a moving file with a skin is refused with after a change.
std::string refusal_after(const std::function<void(Moving&)>& change) {
  Moving file;
  file.skin({1, 1, 1, 1, 1, 1}, {0, 0, 0, 0, 0, 0});
  change(file);
  return file.refusal();
}

TEST(GltfMotion, WhatIsWrongWithASkinIsNamed) {
  const auto still = [](Moving& file) { file.move(1, "translation", {0}, {0, 0, 0}, 3); };
  EXPECT_EQ(refusal_after(still), "");
  const auto error = [&](const std::function<void(Moving&)>& change) {
    return refusal_after([&](Moving& file) {
      still(file);
      change(file);
    });
  };
  EXPECT_EQ(error([](Moving& file) {
              file.pair.json["skins"][0]["joints"] = {1, 9};
            }),
            "a.glb: skins[0].joints is 'array'; a list of numbers below 3 is wanted");
  EXPECT_EQ(
      error([](Moving& file) {
        file.skin({1, 1, 1, 1, 1, 1}, {1, 1, 1, 1, 1, 1});
        file.pair.json["skins"][0]["joints"] = {1};
      }),
      "a.glb: meshes[0].primitives[0] names joint 1 of 1; an existing one, counted from 0, is "
      "wanted");
  EXPECT_EQ(error([](Moving& file) {
              file.skin({1, 1, -1, 1, 1, 1}, {1, 1, 1, 1, 1, 1});
            }),
            "a.glb: meshes[0].primitives[0] has the weight -1 at vertex 2; weights from 0 to 1 are "
            "wanted");
  EXPECT_EQ(
      error([](Moving& file) {
        const float none = std::numeric_limits<float>::quiet_NaN();
        file.skin({1, 1, none, 1, 1, 1}, {1, 1, 1, 1, 1, 1});
      }),
      "a.glb: meshes[0].primitives[0] has the weight nan at vertex 2; weights from 0 to 1 are "
      "wanted");
  EXPECT_EQ(error([](Moving& file) {
              file.pair.json["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_0");
            }),
            "a.glb: meshes[0].primitives[0].attributes has no WEIGHTS_0; joints and weights of a "
            "mesh with a skin are wanted");
  EXPECT_EQ(error([](Moving& file) {
              file.pair.json["skins"][0]["inverseBindMatrices"] =
                  file.add(Floats(16), "MAT4", 5126, 16);
            }),
            "a.glb: skins[0] has 1 inverse bind matrices for 2 joints; one for each is wanted");
  EXPECT_EQ(
      error([](Moving& file) {
        file.pair.json["skins"][0]["inverseBindMatrices"] = file.add(Floats(32), "MAT4", 5126, 16);
      }),
      "a.glb: skins[0] has an inverse bind matrix that is not affine; 0 0 0 1 as the last row "
      "is wanted");
  EXPECT_EQ(error([](Moving& file) {
              file.pair.json["nodes"][1]["children"] = {2};
              file.pair.json["nodes"][2]["children"] = {1};
              file.pair.json["scenes"][0]["nodes"] = {0};
            }),
            "a.glb: nodes[1] is its own ancestor; a tree of nodes is wanted");
}

TEST(GltfMotion, WhatIsWrongWithAnAnimationIsNamed) {
  EXPECT_EQ(refusal_after([](Moving&) {}), "a.glb: animations[0] has no channels; some are wanted");
  EXPECT_EQ(refusal_after([](Moving& file) {
              file.move(1, "translation", {0, 1}, {0, 0, 0}, 3);
            }),
            "a.glb: animations[0].samplers[0] has 1 values; 2, as its keys ask for, are wanted");
  EXPECT_EQ(refusal_after([](Moving& file) {
              file.move(1, "translation", {1, 1}, {0, 0, 0, 0, 0, 0}, 3);
            }),
            "a.glb: animations[0].samplers[0] the time 1 of key 1 does not follow; ascending times "
            "from 0 on are wanted");
  EXPECT_EQ(
      refusal_after([](Moving& file) {
        file.move(1, "translation", {0}, {0, std::numeric_limits<float>::infinity(), 0}, 3);
      }),
      "a.glb: animations[0].samplers[0] holds a number that is not finite; finite numbers are "
      "wanted");
  EXPECT_EQ(refusal_after([](Moving& file) {
              file.move(1, "rotation", {0}, {0, 0, 0, 0}, 4);
            }),
            "a.glb: animations[0].samplers[0] has a rotation without direction; unit quaternions "
            "are wanted");
  EXPECT_EQ(refusal_after([](Moving& file) {
              file.move(1, "rotation", {0, 2},
                        {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -1, 0, 0, 0, 0},
                        4, "CUBICSPLINE");
            }),
            "a.glb: a rotation without direction after 1 s; curves that keep away from 0 are "
            "wanted");
  EXPECT_EQ(refusal_after([](Moving& file) {
              file.move(1, "translation", {0}, {0, 0, 0}, 3, "BEZIER");
            }),
            "a.glb: animations[0].samplers[0] has the interpolation 'BEZIER'; LINEAR, STEP or "
            "CUBICSPLINE is wanted");
  EXPECT_EQ(refusal_after([](Moving& file) {
              file.move(1, "scale", {0}, {1, 1, 1}, 3);
              file.move(1, "scale", {0}, {1, 1, 1}, 3);
            }),
            "a.glb: animations[0].channels[1] moves the scale a second time; one is wanted");
  EXPECT_EQ(
      refusal_after([](Moving& file) {
        file.pair.json["nodes"][1]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        file.move(1, "scale", {0}, {1, 1, 1}, 3);
      }),
      "a.glb: animations[0].channels[0] moves a node that has a matrix; translation, rotation "
      "and scale are wanted in its place");
  EXPECT_EQ(refusal_after([](Moving& file) { file.move(0, "weights", {0}, {1}, 1); }),
            "a.glb: animations[0].channels[0] moves weights that no mesh has; morph targets are "
            "wanted");
  EXPECT_EQ(
      refusal_after([](Moving& file) {
        file.move(1, "translation", {0, 1e30F}, {0, 0, 0, 0, 0, 0}, 3);
      }),
      "a.glb: an animation of 1e+30 s, at 60 frames a second and 4 vertices; a shorter one is "
      "wanted");
  EXPECT_EQ(refusal_after([](Moving& file) {
              file.move(1, "translation", {0}, {3e38F, 0, 0}, 3);
            }),
            "a.glb: a coordinate of point 0 in sample 0 is larger than 1e30; finite numbers are "
            "wanted");
}

TEST(GltfMotion, ChannelsOfExtensionsAreLeftToThem) {
  Moving file;
  file.move(0, "translation", {0}, {1, 0, 0}, 3);
  file.move(0, "pointer", {0}, {1, 0, 0}, 3);
  file.move(0, "scale", {0}, {9, 9, 9}, 3);
  file.pair.json["animations"][0]["channels"][2]["target"].erase("node");
  expect_near(file.at(0, 1), {2, 0, 0});
}

TEST(GltfMotion, FilesAreReadWithTheirBuffers) {
  Moving file;
  file.move(0, "translation", {0}, {1, 0, 0}, 3);
  const test::TemporaryFolder folder;
  file.pair.json["buffers"][0]["uri"] = "the%20data.bin";
  write_file(folder / "the data.bin", [&](std::ostream& out) { out << file.pair.binary; });
  write_file(folder / "a.gltf", [&](std::ostream& out) { out << json_text(file.pair.json); });
  EXPECT_EQ(read_point_cache(folder / "a.gltf").sample(0)[0], (Vec3f{1, 0, 0}));
  EXPECT_EQ(point_cache_files(folder / "a.gltf"),
            (std::vector<std::filesystem::path>{folder / "a.gltf", folder / "the data.bin"}));
  EXPECT_EQ(point_cache_bytes(folder / "a.gltf", {}), 4 * sizeof(Vec3f));
}

}  // namespace
}  // namespace weft
