#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "tests/mesh/gltf_files.h"
#include "tests/support/errors.h"
#include "tests/support/meshes.h"
#include "tests/support/temporary_folder.h"
#include "weft/core/json.h"
#include "weft/mesh.h"

namespace weft {
namespace {

using Json = nlohmann::json;
using test::CreasedPair;

TriangleMesh read(const CreasedPair& file) { return parse_gltf(file.bytes(), "a.glb"); }

std::string refusal(const std::string& bytes) {
  return test::message_of<InputError>([&] { parse_gltf(bytes, "a.glb"); });
}

/// What a file is refused with after a change to its JSON; empty when it is read.
std::string refusal_of(const std::function<void(Json&)>& change) {
  CreasedPair file;
  change(file.json);
  return refusal(file.bytes());
}

TriangleMesh read_with_node(const Json& node) {
  CreasedPair file;
  file.json["nodes"][0] = node;
  file.json["nodes"][0]["mesh"] = 0;
  return read(file);
}

Vec3d normal_of(const TriangleMesh& mesh, std::size_t t = 0) {
  const auto& [a, b, c] = mesh.triangles[t];
  return cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
}

TEST(ReadGltf, VerticesAtEqualPositionsAreJoined) {
  const TriangleMesh mesh = read({});
  EXPECT_EQ(mesh.positions, (std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}));
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}}));
}

TEST(ReadGltf, NodesMoveTurnAndScale) {
  const double h = 0.70710678118654752;
  const TriangleMesh mesh = read_with_node(
      {{"translation", {1, 2, 3}}, {"rotation", {0, 0, h, h}}, {"scale", {2, 1, 1}}});
  EXPECT_NEAR(length(mesh.positions[1] - Vec3d{1, 4, 3}), 0, 1e-12);
  EXPECT_NEAR(length(mesh.positions[2] - Vec3d{0, 2, 3}), 0, 1e-12);
}

TEST(ReadGltf, MatricesAreColumnByColumn) {
  const TriangleMesh mesh =
      read_with_node({{"matrix", {0, 2, 0, 0, 0, 0, 3, 0, 4, 0, 0, 0, 5, 6, 7, 1}}});
  EXPECT_EQ(mesh.positions, (std::vector<Vec3d>{{5, 6, 7}, {5, 8, 7}, {5, 6, 10}, {5, 8, 10}}));
}

TEST(ReadGltf, ChildrenStandInTheirParentsFrame) {
  CreasedPair file;
  file.json["nodes"] = parse_json(R"([{"scale": [2, 2, 2], "children": [1]},
                                       {"translation": [1, 0, 0], "mesh": 0}])",
                                  16);
  EXPECT_EQ(read(file).positions[0], (Vec3d{2, 0, 0}));
}

TEST(ReadGltf, MirroringNodesKeepTheOutside) {
  EXPECT_EQ(normal_of(read({})), (Vec3d{0, 0, 1}));
  EXPECT_EQ(normal_of(read_with_node({{"scale", {1, 1, -1}}})), (Vec3d{0, 0, -1}));
  EXPECT_EQ(normal_of(read_with_node({{"scale", {-1, 1, 1}}})), (Vec3d{0, 0, 1}));
}

TEST(ReadGltf, OnlyTheDefaultSceneIsShown) {
  CreasedPair file;
  file.json["nodes"].push_back({{"mesh", 0}, {"translation", {0, 0, 9}}});
  EXPECT_EQ(read(file).triangles.size(), 2U);
  file.json["scenes"].push_back({{"nodes", {1}}});
  file.json["scene"] = 1;
  EXPECT_EQ(read(file).positions[0].z, 9);
  file.json.erase("scene");
  EXPECT_EQ(read(file).positions[0].z, 0);
  file.json.erase("scenes");
  EXPECT_EQ(read(file).triangles.size(), 4U);
  file.json.erase("nodes");
  EXPECT_EQ(read(file).triangles.size(), 2U);
}

TEST(ReadGltf, StripsAndFansBecomeTriangles) {
  CreasedPair file;
  Json& primitive = file.json["meshes"][0]["primitives"][0];
  primitive["mode"] = 5;
  file.binary.resize(72);
  test::put(file.binary, std::vector<std::uint16_t>{0, 1, 2, 4, 4, 4});
  EXPECT_EQ(read(file).triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}}));
  primitive["mode"] = 6;
  file.binary.resize(72);
  test::put(file.binary, std::vector<std::uint16_t>{0, 1, 4, 2, 2, 2});
  EXPECT_EQ(read(file).triangles, (std::vector<Triangle>{{0, 1, 3}, {0, 3, 2}}));
}

TEST(ReadGltf, VerticesWithoutIndicesComeInOrder) {
  CreasedPair file;
  file.json["meshes"][0]["primitives"][0].erase("indices");
  EXPECT_EQ(read(file).triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}}));
}

TEST(ReadGltf, PrimitivesThatSharePositionsAreOneSurface) {
  CreasedPair file;
  Json& primitives = file.json["meshes"][0]["primitives"];
  primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 1}});  // lines
  file.json["accessors"].push_back(file.json["accessors"][1]);
  file.json["accessors"][1]["count"] = 3;
  file.json["accessors"][2]["count"] = 3;
  file.json["accessors"][2]["byteOffset"] = 6;
  primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"indices", 2}});
  EXPECT_EQ(read(file).triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}}));
}

TEST(ReadGltf, WholeNumbersAreScaledWhenNormalized) {
  CreasedPair file;
  file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  file.json["bufferViews"][0]["byteStride"] = 8;
  file.json["accessors"][0]["componentType"] = 5122;
  file.json["accessors"][0]["count"] = 3;
  file.json["meshes"][0]["primitives"][0].erase("indices");
  file.binary.clear();
  test::put(file.binary, std::vector<std::int16_t>{0, 0, 0, 7, 32767, 0, 0, 7, 0, -32768, 0, 7});
  file.binary.resize(84);
  EXPECT_EQ(read(file).positions[1], (Vec3d{32767, 0, 0}));
  file.json["accessors"][0]["normalized"] = true;
  EXPECT_EQ(read(file).positions, (std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {0, -1, 0}}));
}

TEST(ReadGltf, TextureCoordinatesRunUpwardsAndStayWithTheirCorners) {
  CreasedPair file;
  test::put(file.binary, std::vector<float>{0, 1, 1, 1, 0, 0, 0.25F, 0.75F, 0.25F, 0, 0.125F, 0});
  file.json["buffers"][0]["byteLength"] = 84 + 48;
  file.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 84}, {"byteLength", 48}});
  file.json["accessors"].push_back(
      {{"bufferView", 2}, {"componentType", 5126}, {"count", 6}, {"type", "VEC2"}});
  Json& primitives = file.json["meshes"][0]["primitives"];
  primitives[0]["attributes"]["TEXCOORD_0"] = 2;
  using Corners = std::array<Vec2f, 3>;
  const Corners first{{{0, 0}, {1, 0}, {0, 1}}};
  const Corners second{{{0.25F, 0.25F}, {0.25F, 1}, {0.125F, 1}}};
  EXPECT_EQ(read(file).corner_uv, (std::vector<Corners>{first, second}));
  file.json["nodes"][0]["scale"] = {1, 1, -1};
  EXPECT_EQ(read(file).corner_uv[0], (Corners{{first[0], first[2], first[1]}}));
  file.json["accessors"][2]["count"] = 5;
  EXPECT_EQ(refusal(file.bytes()),
            "a.glb: accessors[2] has 5 texture coordinates for 6 vertices; one for each is wanted");
  file.json["accessors"][2]["count"] = 6;
  primitives.push_back({{"attributes", {{"POSITION", 0}}}});  // one without: none are kept
  EXPECT_TRUE(read(file).corner_uv.empty());
  EXPECT_EQ(read(file).triangles.size(), 4U);
}

TEST(ReadGltf, BuffersMayBeTextOrFilesInTheFolder) {
  const test::TemporaryFolder folder;
  CreasedPair file;
  const auto write = [&](const std::string& name, const std::string& bytes) {
    std::ofstream(folder / name, std::ios::binary) << bytes;
  };
  std::filesystem::create_directory(folder / "parts");
  write("parts/the buffer.bin", file.binary);
  file.json["buffers"][0]["uri"] = "parts/the%20buffer.bin";
  write("a.gltf", json_text(file.json));
  EXPECT_EQ(read_mesh(folder / "a.gltf").triangles.size(), 2U);
  write("parts/the buffer.bin", file.binary.substr(1));
  EXPECT_THROW(read_mesh(folder / "a.gltf"), InputError);
  std::filesystem::remove(folder / "parts/the buffer.bin");
  EXPECT_THROW(read_mesh(folder / "a.gltf"), InputError);

  // One triangle of bytes: 0 0 0, 1 0 0, 0 1 0.
  file.json["buffers"][0] = {{"uri", "data:application/octet-stream;base64,AAAAAQAAAAEA"},
                             {"byteLength", 9}};
  file.json["bufferViews"] = {{{"buffer", 0}, {"byteLength", 9}}};
  file.json["accessors"] = {
      {{"bufferView", 0}, {"componentType", 5121}, {"count", 3}, {"type", "VEC3"}}};
  file.json["meshes"][0]["primitives"][0].erase("indices");
  write("a.gltf", json_text(file.json));
  EXPECT_EQ(read_mesh(folder / "a.gltf").positions,
            (std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

TEST(ReadGltf, FilesElsewhereAreRefused) {
  const test::TemporaryFolder folder;
  for (const char* uri : {"http://example.org/a.bin", "../a.bin", "b/../../a.bin", "/etc/passwd",
                          "file:a.bin", "%2e%2e/a.bin", "", "data:,abc", "data:a/b;base64,???"}) {
    CreasedPair file;
    file.json["buffers"][0]["uri"] = uri;
    std::ofstream(folder / "a.gltf") << json_text(file.json);
    const std::string line = test::message_of<InputError>([&] { read_mesh(folder / "a.gltf"); });
    EXPECT_NE(line.find("buffers[0] "), line.npos) << uri << ": " << line;
  }
  EXPECT_EQ(refusal_of([](Json& json) { json["buffers"][0]["uri"] = "a.bin"; }),
            "a.glb: buffers[0] lies in 'a.bin'; data in the file itself, or a file in the mesh's "
            "folder, are wanted");
}

TEST(ReadGltf, CompressedMeshesAreRefusedByName) {
  const auto required = [](const char* name) {
    return refusal_of([&](Json& json) { json["extensionsRequired"] = {name}; });
  };
  EXPECT_EQ(required("KHR_draco_mesh_compression"),
            "a.glb: needs the extension KHR_draco_mesh_compression; an uncompressed mesh of plain "
            "glTF 2.0 is wanted");
  for (const char* name : {"EXT_meshopt_compression", "EXT_mesh_gpu_instancing", "X_unheard_of"})
    EXPECT_NE(required(name).find(std::string("needs the extension ") + name), std::string::npos);
  EXPECT_EQ(refusal_of([](Json& json) {
              json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = Json::object();
            }),
            "a.glb: bufferViews[0] is compressed by meshopt; an uncompressed mesh is wanted");
}

TEST(ReadGltf, ExtensionsThatLeaveTheShapeAreIgnored) {
  for (const char* name :
       {"KHR_materials_unlit", "KHR_materials_variants", "KHR_materials_pbrSpecularGlossiness",
        "KHR_texture_transform", "KHR_texture_basisu", "KHR_lights_punctual", "KHR_xmp",
        "KHR_xmp_json_ld", "EXT_texture_webp", "EXT_texture_avif", "EXT_lights_ies",
        "EXT_lights_image_based", "MSFT_texture_dds"})
    EXPECT_EQ(refusal_of([&](Json& json) { json["extensionsRequired"] = {name}; }), "") << name;
}

TEST(ReadGltf, VersionOneIsRefusedByName) {
  const std::string wanted = "a.glb: is glTF 1.0; glTF 2.0 is wanted";
  EXPECT_EQ(refusal_of([](Json& json) { json["asset"]["version"] = "1.0"; }), wanted);
  EXPECT_EQ(refusal(R"({"asset": {"version": "1.0.1"}, "meshes": {"m": {}}})"), wanted);
  EXPECT_EQ(refusal(CreasedPair{}.bytes().replace(4, 4, test::u32(1))), wanted);
  EXPECT_EQ(refusal_of([](Json& json) { json["asset"]["version"] = "3.0"; }),
            "a.glb: asset tells version '3.0'; glTF 2.0 is wanted");
}

TEST(ReadGltf, PointsOrLinesAloneAreNoSurface) {
  for (int mode = 0; mode < 4; ++mode)
    EXPECT_EQ(refusal_of([&](Json& json) { json["meshes"][0]["primitives"][0]["mode"] = mode; }),
              std::string("a.glb: holds ") + (mode == 0 ? "points" : "lines") +
                  " only; a surface of triangles is wanted");
}

TEST(ReadGltf, WhatIsWrongIsNamedWithItsPlace) {
  EXPECT_EQ(refusal_of([](Json& json) { json["nodes"][0]["mesh"] = 1; }),
            "a.glb: nodes[0].mesh is '1'; the number of one of 1 is wanted");
  EXPECT_EQ(refusal_of([](Json& json) {
              json["nodes"][0]["scale"] = {1, 2};
            }),
            "a.glb: nodes[0].scale is 'array'; a list of 3 finite numbers is wanted");
  EXPECT_EQ(refusal_of([](Json& json) { json["accessors"][0]["count"] = 4000000000U; }),
            "a.glb: accessors[0].count is '4000000000'; a whole number from 1 to 700000000 is "
            "wanted");
  EXPECT_EQ(refusal_of([](Json& json) { json["accessors"][0]["count"] = 7; }),
            "a.glb: accessors[0] has 7 elements where 6 fit; a whole file is wanted");
  EXPECT_EQ(refusal_of([](Json& json) { json["accessors"][0]["count"] = 5; }),
            "a.glb: accessors[1] names vertex 5 of 5; an existing vertex, counted from 0, is "
            "wanted");
  EXPECT_EQ(refusal_of([](Json& json) { json["nodes"][0]["children"] = {0}; }),
            "a.glb: nodes[0] is reached twice; a tree of nodes is wanted");
}

TEST(ReadGltf, EveryFieldOfAWrongTypeOrRangeIsRefused) {
  const CreasedPair file;
  const Json flat = file.json.flatten();
  for (const auto& [place, value] : flat.items())
    for (const Json& wrong : {Json(nullptr), Json(-1), Json(1.5), Json("x"), Json::array(),
                              Json(18446744073709551615U), Json::object()}) {
      CreasedPair damaged = file;
      damaged.json[Json::json_pointer(place)] = wrong;
      EXPECT_NE(refusal(damaged.bytes()), "") << place << " = " << wrong;
    }
}

TEST(ReadGltf, EveryCutIsNoticed) {
  const std::string whole = CreasedPair{}.bytes();
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_NE(refusal(whole.substr(0, size)), "") << "cut after " << size << " bytes";
}

TEST(ReadGltf, ContainersWithWrongLengthsAreRefused) {
  const std::string whole = CreasedPair{}.bytes();
  const std::size_t binary_chunk = whole.size() - 84 - 8;
  for (const std::size_t at : {std::size_t{4}, std::size_t{8}, std::size_t{12}, binary_chunk})
    for (const std::size_t value : {std::size_t{0}, std::size_t{0xffffffff}, whole.size() + 8}) {
      std::string bytes = whole;
      bytes.replace(at, 4, test::u32(value));
      EXPECT_NE(refusal(bytes), "") << value << " at " << at;
    }
}

TEST(ReadGltf, NotFiniteCoordinatesAreRefused) {
  CreasedPair file;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  file.binary.replace(16, 4, std::string(reinterpret_cast<const char*>(&nan), 4));
  EXPECT_EQ(
      refusal(file.bytes()),
      "a.glb: meshes[0].primitives[0] has a coordinate that is not finite; finite numbers are "
      "wanted");
  EXPECT_NE(refusal_of([](Json& json) { json["nodes"][0]["translation"] = {1e31, 0, 0}; }), "");
}

/// A file of some kilobytes must not fill the memory by showing one mesh again and again.
TEST(ReadGltf, RepeatedMeshesAreBounded) {
  constexpr std::size_t corners = 30000;
  CreasedPair file;
  file.binary.resize(72);
  for (std::size_t i = 0; i < corners / 6; ++i)
    test::put(file.binary, std::vector<std::uint16_t>{0, 1, 2, 3, 4, 5});
  file.json["buffers"][0]["byteLength"] = file.binary.size();
  file.json["bufferViews"][1]["byteLength"] = 2 * corners;
  file.json["accessors"][1]["count"] = corners;
  file.json["nodes"] = Json::array();
  Json& shown = file.json["scenes"][0]["nodes"] = Json::array();
  for (int i = 0; i < 401; ++i) {
    file.json["nodes"].push_back({{"mesh", 0}});
    shown.push_back(i);
  }
  EXPECT_EQ(refusal(file.bytes()),
            "a.glb: meshes[0].primitives[0] is shown so often that there are 4010000 elements; at "
            "most 4000000 are wanted");
}

}  // namespace
}  // namespace weft
