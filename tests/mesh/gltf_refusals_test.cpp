// Skins and animations of glTF files that are refused.
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/mesh/moving_pair.h"

namespace weft {
namespace {

using test::expect_near;
using test::half;
using test::MovingPair;
using Json = nlohmann::json;
using Floats = std::vector<float>;

/// What a moving file with a skin is refused with after a change.
std::string refusal_after(const std::function<void(MovingPair&)>& change) {
  MovingPair file;
  file.skin({1, 1, 1, 1, 1, 1}, {0, 0, 0, 0, 0, 0});
  change(file);
  return file.refusal();
}

TEST(GltfMotion, WhatIsWrongWithASkinIsNamed) {
  const auto still = [](MovingPair& file) { file.move(1, "translation", {0}, {0, 0, 0}, 3); };
  EXPECT_EQ(refusal_after(still), "");
  const auto error = [&](const std::function<void(MovingPair&)>& change) {
    return refusal_after([&](MovingPair& file) {
      still(file);
      change(file);
    });
  };
  EXPECT_EQ(error([](MovingPair& file) {
              file.pair.json["skins"][0]["joints"] = {1, 9};
            }),
            "a.glb: skins[0].joints is 'array'; a list of numbers below 3 is wanted");
  EXPECT_EQ(
      error([](MovingPair& file) {
        file.skin({1, 1, 1, 1, 1, 1}, {1, 1, 1, 1, 1, 1});
        file.pair.json["skins"][0]["joints"] = {1};
      }),
      "a.glb: meshes[0].primitives[0] names joint 1 of 1; an existing one, counted from 0, is "
      "wanted");
  EXPECT_EQ(error([](MovingPair& file) {
              file.skin({1, 1, -1, 1, 1, 1}, {1, 1, 1, 1, 1, 1});
            }),
            "a.glb: meshes[0].primitives[0] has the weight -1 at vertex 2; weights from 0 to 1 are "
            "wanted");
  EXPECT_EQ(
      error([](MovingPair& file) {
        const float none = std::numeric_limits<float>::quiet_NaN();
        file.skin({1, 1, none, 1, 1, 1}, {1, 1, 1, 1, 1, 1});
      }),
      "a.glb: meshes[0].primitives[0] has the weight nan at vertex 2; weights from 0 to 1 are "
      "wanted");
  EXPECT_EQ(error([](MovingPair& file) {
              file.pair.json["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_0");
            }),
            "a.glb: meshes[0].primitives[0].attributes has no WEIGHTS_0; joints and weights of a "
            "mesh with a skin are wanted");
  EXPECT_EQ(error([](MovingPair& file) {
              file.pair.json["skins"][0]["inverseBindMatrices"] =
                  file.add(Floats(16), "MAT4", 5126, 16);
            }),
            "a.glb: skins[0] has 1 inverse bind matrices for 2 joints; one for each is wanted");
  EXPECT_EQ(
      error([](MovingPair& file) {
        file.pair.json["skins"][0]["inverseBindMatrices"] = file.add(Floats(32), "MAT4", 5126, 16);
      }),
      "a.glb: skins[0] has an inverse bind matrix that is not affine; 0 0 0 1 as the last row "
      "is wanted");
  EXPECT_EQ(error([](MovingPair& file) {
              file.pair.json["nodes"][1]["children"] = {2};
              file.pair.json["nodes"][2]["children"] = {1};
              file.pair.json["scenes"][0]["nodes"] = {0};
            }),
            "a.glb: nodes[1] is its own ancestor; a tree of nodes is wanted");
}

TEST(GltfMotion, WhatIsWrongWithAnAnimationIsNamed) {
  EXPECT_EQ(refusal_after([](MovingPair&) {}),
            "a.glb: animations[0] has no channels; some are wanted");
  EXPECT_EQ(refusal_after([](MovingPair& file) {
              file.move(1, "translation", {0, 1}, {0, 0, 0}, 3);
            }),
            "a.glb: animations[0].samplers[0] has 1 values; 2, as its keys ask for, are wanted");
  EXPECT_EQ(refusal_after([](MovingPair& file) {
              file.move(1, "translation", {1, 1}, {0, 0, 0, 0, 0, 0}, 3);
            }),
            "a.glb: animations[0].samplers[0] the time 1 of key 1 does not follow; ascending times "
            "from 0 on are wanted");
  EXPECT_EQ(
      refusal_after([](MovingPair& file) {
        file.move(1, "translation", {0}, {0, std::numeric_limits<float>::infinity(), 0}, 3);
      }),
      "a.glb: animations[0].samplers[0] holds a number that is not finite; finite numbers are "
      "wanted");
  EXPECT_EQ(refusal_after([](MovingPair& file) {
              file.move(1, "rotation", {0}, {0, 0, 0, 0}, 4);
            }),
            "a.glb: animations[0].samplers[0] has a rotation without direction; unit quaternions "
            "are wanted");
  EXPECT_EQ(refusal_after([](MovingPair& file) {
              file.move(1, "rotation", {0, 2},
                        {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -1, 0, 0, 0, 0},
                        4, "CUBICSPLINE");
            }),
            "a.glb: a rotation without direction after 1 s; curves that keep away from 0 are "
            "wanted");
  EXPECT_EQ(refusal_after([](MovingPair& file) {
              file.move(1, "translation", {0}, {0, 0, 0}, 3, "BEZIER");
            }),
            "a.glb: animations[0].samplers[0] has the interpolation 'BEZIER'; LINEAR, STEP or "
            "CUBICSPLINE is wanted");
  EXPECT_EQ(refusal_after([](MovingPair& file) {
              file.move(1, "scale", {0}, {1, 1, 1}, 3);
              file.move(1, "scale", {0}, {1, 1, 1}, 3);
            }),
            "a.glb: animations[0].channels[1] moves the scale a second time; one is wanted");
  EXPECT_EQ(
      refusal_after([](MovingPair& file) {
        file.pair.json["nodes"][1]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        file.move(1, "scale", {0}, {1, 1, 1}, 3);
      }),
      "a.glb: animations[0].channels[0] moves a node that has a matrix; translation, rotation "
      "and scale are wanted in its place");
  EXPECT_EQ(refusal_after([](MovingPair& file) { file.move(0, "weights", {0}, {1}, 1); }),
            "a.glb: animations[0].channels[0] moves weights that no mesh has; morph targets are "
            "wanted");
  EXPECT_EQ(
      refusal_after([](MovingPair& file) {
        file.move(1, "translation", {0, 1e30F}, {0, 0, 0, 0, 0, 0}, 3);
      }),
      "a.glb: an animation of 1e+30 s, at 60 frames a second and 4 vertices; a shorter one is "
      "wanted");
  EXPECT_EQ(refusal_after([](MovingPair& file) {
              file.move(1, "translation", {0}, {3e38F, 0, 0}, 3);
            }),
            "a.glb: a coordinate of point 0 in sample 0 is larger than 1e30; finite numbers are "
            "wanted");
}

}  // namespace
}  // namespace weft
