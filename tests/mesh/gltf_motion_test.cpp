// Animations of nodes in glTF files.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/mesh/moving_pair.h"
#include "tests/support/temporary_folder.h"
#include "weft/files.h"
#include "weft/mesh.h"
#include "weft/point_cache.h"

namespace weft {
namespace {

using test::expect_near;
using test::half;
using test::MovingPair;
using Json = nlohmann::json;
using Floats = std::vector<float>;

TEST(GltfMotion, LinearKeysHoldBeforeAndAfter) {
  MovingPair file;
  file.move(0, "translation", {1, 3}, {0, 0, 0, 4, 0, 2}, 3);
  EXPECT_EQ(file.rig().duration, 3);
  expect_near(file.at(0), {0, 0, 0});
  expect_near(file.at(1.5), {1, 0, 0.5});
  expect_near(file.at(3), {4, 0, 2});
  expect_near(file.at(9), {4, 0, 2});
}

TEST(GltfMotion, StepsStayUntilTheNextKey) {
  MovingPair file;
  file.move(0, "translation", {0, 1, 2}, {0, 0, 0, 1, 0, 0, 5, 0, 0}, 3, "STEP");
  EXPECT_EQ(file.at(0.999).x, 0);
  EXPECT_EQ(file.at(1).x, 1);
  EXPECT_EQ(file.at(1.999).x, 1);
  EXPECT_EQ(file.at(2).x, 5);
}

TEST(GltfMotion, CubicSplinesPassKeysWithTheirTangents) {
  MovingPair file;
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
    MovingPair file;
    file.move(0, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, sign * h, sign * h}, 4);
    for (const double part : {0.25, 0.5, 0.75}) {
      const double angle = part * 1.5707963267948966;
      expect_near(file.at(part, 1), {std::cos(angle), std::sin(angle), 0}, 1e-7);
    }
  }
}

TEST(GltfMotion, CubicRotationsAreMadeUnitQuaternions) {
  MovingPair file;
  file.move(0, "rotation", {0, 1},
            {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0}, 4,
            "CUBICSPLINE");
  expect_near(file.at(0.5, 1), {0, 1, 0}, 1e-12);  // half way between none and 180 degrees
  EXPECT_NEAR(length(file.at(0.3, 1)), 1, 1e-12);
}

TEST(GltfMotion, ChildrenGoWithTheirParents) {
  MovingPair file;
  file.pair.json["nodes"] = parse_json(R"([{"mesh": 0, "translation": [1, 0, 0]},
                                           {"children": [0], "scale": [2, 2, 2]}])",
                                       16);
  file.pair.json["scenes"][0]["nodes"] = {1};
  file.move(1, "translation", {0, 1}, {0, 0, 0, 0, 6, 0}, 3);
  file.move(0, "translation", {0, 1}, {1, 0, 0, 3, 0, 0}, 3);
  expect_near(file.at(0.5), {4, 3, 0});
}

TEST(GltfMotion, AnimationsHaveNames) {
  MovingPair file;
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
  MovingPair file;
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
    MovingPair file;
    file.move(0, "translation", {0, end}, {0, 0, 0, 1, 0, 0}, 3);
    const PointCache cache = parse_gltf_motion(file.pair.bytes(), "a.glb", {});
    EXPECT_EQ(cache.samples(), 208) << end;
    EXPECT_EQ(cache.times.back(), end);
    EXPECT_EQ(cache.sample(207)[0].x, 1);
  }
}

TEST(GltfMotion, FirstSampleOfAStillFileIsItsMesh) {
  MovingPair file;
  file.pair.json["nodes"][0] = {{"mesh", 0}, {"translation", {1, 2, 3}}, {"scale", {1, 2, 1}}};
  file.move(0, "scale", {0}, {1, 2, 1}, 3);
  const std::vector<Vec3d> mesh = parse_gltf(file.pair.bytes(), "a.glb").positions;
  EXPECT_EQ(positions_at(file.rig(), 0), mesh);
}

TEST(GltfMotion, ChannelsOfExtensionsAreLeftToThem) {
  MovingPair file;
  file.move(0, "translation", {0}, {1, 0, 0}, 3);
  file.move(0, "pointer", {0}, {1, 0, 0}, 3);
  file.move(0, "scale", {0}, {9, 9, 9}, 3);
  file.pair.json["animations"][0]["channels"][2]["target"].erase("node");
  expect_near(file.at(0, 1), {2, 0, 0});
}

TEST(GltfMotion, FilesAreReadWithTheirBuffers) {
  MovingPair file;
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
