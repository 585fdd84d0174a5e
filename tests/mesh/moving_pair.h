#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "tests/mesh/gltf_files.h"
#include "tests/support/errors.h"
#include "weft/error.h"
#include "weft/mesh/io/gltf_rig.h"
#include "weft/mesh/io/motion_files.h"

namespace weft::test {

using Json = nlohmann::json;
using Floats = std::vector<float>;

inline const double half = 0.70710678118654752;

/// Two triangles (CreasedPair) shown by node 0, with one animation, 'move'.
struct MovingPair {
  CreasedPair pair;

  MovingPair() {
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
    put(pair.binary, numbers);
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
    return message_of<InputError>(
        [&] { parse_gltf_motion(pair.bytes(), "a.glb", {std::string(clip)}); });
  }
};

inline void expect_near(Vec3d found, Vec3d wanted, double tolerance = 1e-12) {
  EXPECT_NEAR(found.x, wanted.x, tolerance);
  EXPECT_NEAR(found.y, wanted.y, tolerance);
  EXPECT_NEAR(found.z, wanted.z, tolerance);
}

/// A file with two morph targets: all vertices by 1 along x, and by 2 along y.
inline MovingPair morphing() {
  MovingPair file;
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

}  // namespace weft::test
