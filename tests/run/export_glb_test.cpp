// GLB, read by a library of others.
#include <cstring>

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include "tests/run/exported_runs.h"
#include "weft/mesh.h"

namespace weft {
namespace {

using test::as_floats;
using test::ExportedRun;
using test::thrown_ring;
constexpr int frame_count = test::exported_frames;

tinygltf::Model load_glb(const std::filesystem::path& path) {
  tinygltf::TinyGLTF loader;
  tinygltf::Model model;
  std::string error, warning;
  EXPECT_TRUE(loader.LoadBinaryFromFile(&model, &error, &warning, path.string())) << error;
  EXPECT_EQ(warning, "");
  return model;
}

template <class T>
std::vector<T> values(const tinygltf::Model& model, int accessor_index) {
  const auto& accessor = model.accessors.at(static_cast<std::size_t>(accessor_index));
  const auto& view = model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
  const auto& data = model.buffers.at(static_cast<std::size_t>(view.buffer)).data;
  std::vector<T> found(accessor.count);
  EXPECT_LE(view.byteOffset + accessor.byteOffset + sizeof(T) * accessor.count, data.size());
  EXPECT_EQ(accessor.ByteStride(view), static_cast<int>(sizeof(T)));
  std::memcpy(found.data(), data.data() + view.byteOffset + accessor.byteOffset,
              sizeof(T) * accessor.count);
  return found;
}

TEST(Exports, GlbTargetsAndWeightsGiveEveryFrame) {
  const ExportedRun run(thrown_ring());
  const tinygltf::Model model = load_glb(run.folder / "ring.glb");
  const tinygltf::Primitive& mesh = model.meshes.at(0).primitives.at(0);
  const auto base = values<Vec3f>(model, mesh.attributes.at("POSITION"));
  const auto normals = values<Vec3f>(model, mesh.attributes.at("NORMAL"));
  const auto uv = values<Vec2f>(model, mesh.attributes.at("TEXCOORD_0"));
  // Both seams of the ring are there twice, their crossing four times.
  ASSERT_EQ(base.size(), 17 * 17);
  ASSERT_EQ(mesh.targets.size(), frame_count);
  EXPECT_EQ(uv.size(), base.size());
  for (const Vec3f n : normals) EXPECT_NEAR(length(n), 1, 1e-6);
  const tinygltf::Animation& animation = model.animations.at(0);
  EXPECT_EQ(animation.channels.at(0).target_path, "weights");
  const auto times = values<float>(model, animation.samplers.at(0).input);
  const auto weights = values<float>(model, animation.samplers.at(0).output);
  ASSERT_EQ(times.size(), frame_count + 1);
  ASSERT_EQ(weights.size(), frame_count * (frame_count + 1));
  for (int frame = 0; frame <= frame_count; ++frame) {
    EXPECT_FLOAT_EQ(times[frame], static_cast<float>(frame) / 60);
    std::vector<Vec3f> shown = base;
    for (int k = 0; k < frame_count; ++k) {
      const auto target = values<Vec3f>(model, mesh.targets[k].at("POSITION"));
      for (std::size_t v = 0; v < shown.size(); ++v)
        shown[v] += weights[frame * frame_count + k] * target[v];
    }
    const std::vector<Vec3f> wanted = run.points(frame);
    for (std::size_t v = 0; v < wanted.size(); ++v)
      EXPECT_LT(length(shown[v] - wanted[v]), 1e-6) << frame << " " << v;
  }
}

TEST(Exports, GlbTellsItsExtremesAndItsTrianglesAreThoseOfTheObj) {
  const ExportedRun run(thrown_ring());
  const tinygltf::Model model = load_glb(run.folder / "ring.glb");
  const tinygltf::Primitive& primitive = model.meshes.at(0).primitives.at(0);
  const auto base = values<Vec3f>(model, primitive.attributes.at("POSITION"));
  const auto uv = values<Vec2f>(model, primitive.attributes.at("TEXCOORD_0"));
  const auto& accessor =
      model.accessors.at(static_cast<std::size_t>(primitive.attributes.at("POSITION")));
  Vec3f minimum = base[0], maximum = base[0];
  for (const Vec3f p : base) {
    minimum = min(minimum, p);
    maximum = max(maximum, p);
  }
  EXPECT_EQ(accessor.minValues, (std::vector<double>{minimum.x, minimum.y, minimum.z}));
  EXPECT_EQ(accessor.maxValues, (std::vector<double>{maximum.x, maximum.y, maximum.z}));
  const TriangleMesh obj = read_mesh(run.folder / "ring.obj");
  const auto corners = values<std::uint32_t>(model, primitive.indices);
  ASSERT_EQ(corners.size(), 3 * obj.triangles.size());
  for (std::size_t t = 0; t < obj.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto corner = static_cast<std::size_t>(corners[3 * t + k]);
      EXPECT_EQ(base.at(corner), vec_cast<float>(obj.positions[obj.triangles[t][k]]));
      EXPECT_EQ(uv.at(corner).x, obj.corner_uv[t][k].x);
      EXPECT_EQ(uv.at(corner).y, 1 - obj.corner_uv[t][k].y);
    }
}

TEST(Exports, GlbInOtherUnitsStandsInMetresWithYUp) {
  Scene scene = thrown_ring();
  scene.files = {*find_length_unit("cm"), true};
  const ExportedRun run(scene);
  const tinygltf::Node node = load_glb(run.folder / "ring.glb").nodes.at(0);
  EXPECT_EQ(node.scale, (std::vector<double>{0.01, 0.01, 0.01}));
  // Our own reader heeds the node.
  const std::vector<Vec3d> found = read_mesh(run.folder / "ring.glb").positions;
  const ExportedRun metres(thrown_ring());
  const std::vector<Vec3d> wanted = read_mesh(metres.folder / "ring.glb").positions;
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t v = 0; v < found.size(); ++v) EXPECT_LT(length(found[v] - wanted[v]), 1e-6);
}

}  // namespace
}  // namespace weft
