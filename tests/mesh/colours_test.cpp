// Colours of mesh files: of vertices, materials and pictures.
#include <cmath>
#include <functional>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/mesh/gltf_files.h"
#include "tests/support/errors.h"
#include "tests/support/temporary_folder.h"
#include "weft/core/json.h"
#include "weft/files.h"
#include "weft/mesh.h"
#include "weft/mesh/io/texture_picture.h"
#include "weft/mesh_colours.h"

namespace weft {
namespace {

using Bytes = std::array<std::uint8_t, 3>;
constexpr std::array<double, 3> first{1, 0, 0}, second{0, 1, 0}, third{0, 0, 1};

std::string bytes_of(std::string_view digits) {
  std::string bytes;
  for (std::size_t i = 0; i < digits.size(); i += 2)
    bytes += static_cast<char>(std::stoi(std::string(digits.substr(i, 2)), nullptr, 16));
  return bytes;
}

/// 2 x 2 texels: red, green; blue, white. As PNG of 8-bit RGB.
const std::string four_texels = bytes_of(
    "89504e470d0a1a0a0000000d4948445200000002000000020802000000fdd49a73000000124944415478da63"
    "f8cfc0c000c20cff8100001fee05fbf1abba770000000049454e44ae426082");

/// One texel, 100 200 50 of 255, as PNG of 16-bit RGB.
const std::string deep_texel = bytes_of(
    "89504e470d0a1a0a0000000d4948445200000001000000011002000000c0e78f9d0000000f49444154789c6348"
    "493971c2c808000a6102bde90eb0bb0000000049454e44ae426082");

class ColouredFiles : public ::testing::Test {
 protected:
  void put(const std::string& name, const std::string& bytes) {
    write_file(folder_ / name, [&](std::ostream& out) { out << bytes; });
  }
  SurfaceColours read(const std::string& name, const std::string& bytes) {
    put(name, bytes);
    return read_colours(folder_ / name);
  }
  std::string refusal(const std::string& name, const std::string& bytes) {
    const std::string said = test::message_of<InputError>([&] { read(name, bytes); });
    const std::string prefix = (folder_ / "").string();
    return said.starts_with(prefix) ? said.substr(prefix.size()) : said;
  }
  test::TemporaryFolder folder_;
};

TEST(Colours, DisplayBytesComeBackFromLinearLight) {
  for (int k = 0; k < 256; ++k) {
    const float display = static_cast<float>(k) / 255;
    const auto byte = static_cast<std::uint8_t>(k);
    EXPECT_EQ(display_bytes(linear_colour({display, 0, 1})), (Bytes{byte, 0, 255}));
  }
  EXPECT_NEAR(linear_colour({0.5F, 0, 0}).x, std::pow((0.5 + 0.055) / 1.055, 2.4), 1e-7);
  EXPECT_NEAR(linear_colour({0.03F, 0, 0}).x, 0.03 / 12.92, 1e-9);
}

TEST_F(ColouredFiles, PlyVerticesHaveBytesOrFloats) {
  const std::string tail = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\n";
  const SurfaceColours bytes =
      read("a.ply", head + "property uchar red\nproperty uchar green\nproperty uchar blue\n" +
                        tail + "0 0 0 255 0 0\n1 0 0 0 128 0\n0 1 0 0 0 51\n3 0 1 2\n");
  EXPECT_EQ(display_bytes(bytes.at(0, first)), (Bytes{255, 0, 0}));
  EXPECT_EQ(display_bytes(bytes.at(0, second)), (Bytes{0, 128, 0}));
  const SurfaceColours floats =
      read("b.ply", head +
                        "property float diffuse_red\nproperty float diffuse_green\n"
                        "property float diffuse_blue\n" +
                        tail + "0 0 0 1 0 0\n1 0 0 0 1 0\n0 1 0 0 0 0.2\n3 0 1 2\n");
  EXPECT_EQ(display_bytes(floats.at(0, third)), (Bytes{0, 0, 51}));
  EXPECT_FLOAT_EQ(floats.at(0, {0.5, 0.5, 0}).x, 0.5F) << "in linear light";
  EXPECT_EQ(linear_colour({NAN, -1, HUGE_VALF}), (Vec3f{0, 0, 1}));
}

TEST_F(ColouredFiles, PlyNumbersOfAnyTypeGoUpTo255WhereTheyAreAboveOne) {
  for (const std::string type : {"int", "uint", "short", "float", "double"}) {
    std::string head =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\n";
    for (const std::string axis : {"red", "green", "blue"})
      head += "property " + type + " " + axis + "\n";
    const SurfaceColours colours =
        read("c.ply", head +
                          "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                          "0 0 0 255 0 0\n1 0 0 0 128 0\n0 1 0 200 100 50\n3 0 1 2\n");
    EXPECT_EQ(display_bytes(colours.at(0, second)), (Bytes{0, 128, 0})) << type;
    EXPECT_EQ(display_bytes(colours.at(0, third)), (Bytes{200, 100, 50})) << type;
  }
}

TEST_F(ColouredFiles, PlyNamesItsPictureInAComment) {
  put("four.png", four_texels);
  const SurfaceColours colours = read(
      "a.ply",
      "ply\nformat ascii 1.0\ncomment TextureFile four.png\nelement vertex 3\nproperty float x\n"
      "property float y\nproperty float z\nproperty float s\nproperty float t\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0 0.25 0.75\n1 0 0 0.75 0.75\n"
      "0 1 0 0.25 0.25\n3 0 1 2\n");
  EXPECT_EQ(display_bytes(colours.at(0, first)), (Bytes{255, 0, 0}));
  EXPECT_EQ(display_bytes(colours.at(0, second)), (Bytes{0, 255, 0}));
  EXPECT_EQ(display_bytes(colours.at(0, third)), (Bytes{0, 0, 255}));
}

TEST_F(ColouredFiles, ObjVerticesHaveColoursBehindTheirPositions) {
  const SurfaceColours colours =
      read("a.obj", "v 0 0 0 1 0 0\nv 1 0 0 0 0.2 0\nv 0 1 0\nv 1 1 0 0 0 1\nf 1 2 4 3\n");
  ASSERT_EQ(colours.corners.size(), 2U);
  EXPECT_EQ(display_bytes(colours.at(0, second)), (Bytes{0, 51, 0}));
  EXPECT_EQ(display_bytes(colours.at(1, second)), (Bytes{0, 0, 255}));
  EXPECT_EQ(display_bytes(colours.at(1, third)), (Bytes{255, 255, 255})) << "without colour";
  const SurfaceColours bytes =
      read("b.obj", "v 0 0 0 255 0 0\nv 1 0 0 0 51 0\nv 0 1 0 0 0 0\nf 1 2 3\n");
  EXPECT_EQ(display_bytes(bytes.at(0, second)), (Bytes{0, 51, 0}));
}

const std::string two_faces =
    "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0.25 0.25\nvt 0.75 0.25\nvt 0.75 0.75\n"
    "usemtl plain\nf 1 2 3\nusemtl pictured\nf 1/1 3/2 4/3\n";

TEST_F(ColouredFiles, ObjMaterialsHaveColoursAndPictures) {
  put("four.png", four_texels);
  put("a.mtl",
      "# made by hand\nnewmtl plain\nKd 0.2 0 1\nnewmtl pictured\nKd 0.8 0.8 0.8\n"
      "map_Kd -clamp on four.png\n");
  const SurfaceColours colours = read("a.obj", two_faces);
  EXPECT_EQ(display_bytes(colours.at(0, first)), (Bytes{51, 0, 255}));
  EXPECT_EQ(display_bytes(colours.at(1, first)), (Bytes{0, 0, 255}));
  EXPECT_EQ(display_bytes(colours.at(1, second)), (Bytes{255, 255, 255}));
  EXPECT_EQ(display_bytes(colours.at(1, third)), (Bytes{0, 255, 0}));
  EXPECT_TRUE(colours.parts[1].clamped);
}

/// Scaled and then moved, as programs that write OBJ mean it.
TEST_F(ColouredFiles, ObjPicturesLieWhereTheirMaterialsPutThem) {
  put("four.png", four_texels);
  const auto pictured = [&](const std::string& options) {
    put("a.mtl", "newmtl pictured\nmap_Kd " + options + " four.png\n");
    return read("a.obj", two_faces);
  };
  const SurfaceColours as_it_is = pictured("-clamp off"), moved = pictured("-o 0.5 0 0"),
                       mirrored = pictured("-s -1 1 1 -o 1"), narrow = pictured("-blendu on -s 3");
  EXPECT_EQ(display_bytes(moved.at(1, first)), display_bytes(as_it_is.at(1, second)));
  EXPECT_EQ(display_bytes(mirrored.at(1, first)), display_bytes(as_it_is.at(1, second)));
  EXPECT_EQ(display_bytes(mirrored.at(1, second)), display_bytes(as_it_is.at(1, first)));
  EXPECT_EQ(display_bytes(narrow.at(1, first)), display_bytes(as_it_is.at(1, second)));
}

TEST_F(ColouredFiles, WhatIsWrongWithMaterialsIsNamed) {
  EXPECT_NE(refusal("a.obj", two_faces).find("a.mtl"), std::string::npos) << "missing";
  put("a.mtl", "newmtl plain\nKd 0.2 red 1\n");
  EXPECT_EQ(refusal("a.obj", two_faces),
            "a.mtl:2: the colour 'red'; Kd red green blue, from 0 to 1, is wanted");
  put("a.mtl", "newmtl plain\nmap_Kd -t 1 1 1 four.png\n");
  EXPECT_EQ(refusal("a.obj", two_faces),
            "a.mtl:2: a picture with turbulence (-t); one that lies as it is is wanted");
  put("a.mtl", "newmtl plain\nmap_Kd -s big four.png\n");
  EXPECT_EQ(refusal("a.obj", two_faces),
            "a.mtl:2: 'big' behind -s; one to three numbers up to 1e6 are wanted");
  put("a.mtl", "newmtl plain\nmap_Kd ../four.png\n");
  EXPECT_EQ(refusal("a.obj", two_faces),
            "a.obj: names the file '../four.png'; one in the mesh's folder or below is wanted");
  put("a.mtl", "newmtl plain\nmap_Kd four.png\n");
  put("four.png", four_texels.substr(0, 60));
  EXPECT_NE(refusal("a.obj", two_faces).find("four.png: a damaged PNG picture"), std::string::npos);
  put("four.png", "GIF89a");
  EXPECT_NE(refusal("a.obj", two_faces).find("is neither a PNG nor a JPEG"), std::string::npos);
  EXPECT_EQ(refusal("plain.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
            "plain.obj: has no colours; vertex colours, or materials with colours or pictures, are "
            "wanted");
  EXPECT_EQ(refusal("a.stl", "solid a\nendsolid a\n"),
            "a.stl: a format without colours; PLY, OBJ, GLB or glTF is wanted");
}

TEST_F(ColouredFiles, GltfHasColoursOfVerticesAndMaterials) {
  test::CreasedPair pair;
  const std::size_t start = pair.binary.size();
  std::vector<float> colours;
  for (int v = 0; v < 6; ++v) colours.insert(colours.end(), {v == 0 ? 1.0F : 0.5F, 1, 0.25F, 0.5F});
  test::put(pair.binary, colours);
  pair.json["buffers"][0]["byteLength"] = pair.binary.size();
  pair.json["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", start}, {"byteLength", 4 * colours.size()}});
  pair.json["accessors"].push_back(
      {{"bufferView", 2}, {"componentType", 5126}, {"count", 6}, {"type", "VEC4"}});
  nlohmann::json& primitive = pair.json["meshes"][0]["primitives"][0];
  primitive["attributes"]["COLOR_0"] = 2;
  primitive["material"] = 0;
  pair.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.5, 1, 1}}}}}};
  const SurfaceColours read_ones = read("a.glb", pair.bytes());
  EXPECT_EQ(read_ones.at(0, first), (Vec3f{0.5F, 0.5F, 0.25F}));
  EXPECT_EQ(read_ones.at(1, second), (Vec3f{0.25F, 0.5F, 0.25F}));
}

/// Two triangles with a picture of four texels in the file, whose corners are in texels' middles.
test::CreasedPair pictured_pair() {
  test::CreasedPair pair;
  const std::size_t start = pair.binary.size();
  test::put(pair.binary,
            std::vector<float>{.25, .25, .75, .25, .25, .75, .75, .25, .75, .75, .25, .75});
  const std::size_t picture = pair.binary.size();
  pair.binary += four_texels;
  pair.json["buffers"][0]["byteLength"] = pair.binary.size();
  pair.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", start}, {"byteLength", 48}});
  pair.json["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", picture}, {"byteLength", four_texels.size()}});
  pair.json["accessors"].push_back(
      {{"bufferView", 2}, {"componentType", 5126}, {"count", 6}, {"type", "VEC2"}});
  nlohmann::json& primitive = pair.json["meshes"][0]["primitives"][0];
  primitive["attributes"]["TEXCOORD_0"] = 2;
  primitive["material"] = 0;
  pair.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  pair.json["textures"] = {{{"source", 0}}};
  pair.json["images"] = {{{"bufferView", 3}, {"mimeType", "image/png"}}};
  return pair;
}

TEST_F(ColouredFiles, GltfPicturesLieInTheFileOrBesideIt) {
  test::CreasedPair pair = pictured_pair();
  const auto check = [](const SurfaceColours& found) {
    // In glTF v runs downwards: (0.25, 0.25) is the upper left texel.
    EXPECT_EQ(display_bytes(found.at(0, first)), (Bytes{255, 0, 0}));
    EXPECT_EQ(display_bytes(found.at(0, second)), (Bytes{0, 255, 0}));
    EXPECT_EQ(display_bytes(found.at(1, second)), (Bytes{255, 255, 255}));
  };
  check(read("a.glb", pair.bytes()));
  put("four.png", four_texels);
  pair.json["images"] = {{{"uri", "four.png"}}};
  check(read("b.glb", pair.bytes()));
  pair.json["images"] = {{{"uri", "../four.png"}}};
  EXPECT_NE(refusal("c.glb", pair.bytes()).find("lies in '../four.png'"), std::string::npos);
  pair.json["textures"] = {{{"sampler", 0}}};
  EXPECT_NE(refusal("d.glb", pair.bytes()).find("has no picture"), std::string::npos);
}

TEST_F(ColouredFiles, GltfPicturesAreMovedAsTheirMaterialSays) {
  test::CreasedPair pair = pictured_pair();
  nlohmann::json& picture = pair.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  const auto colours_by = [&](const nlohmann::json& transform) {
    picture["extensions"] = {{"KHR_texture_transform", transform}};
    const SurfaceColours found = read("a.glb", pair.bytes());
    return std::array{display_bytes(found.at(0, first)), display_bytes(found.at(0, second)),
                      display_bytes(found.at(1, second))};
  };
  const Bytes red{255, 0, 0}, green{0, 255, 0}, blue{0, 0, 255}, white{255, 255, 255};
  EXPECT_EQ(colours_by(nlohmann::json::object()), (std::array{red, green, white}));
  EXPECT_EQ(colours_by({{"offset", {0.5, 0}}}), (std::array{green, red, blue}));
  EXPECT_EQ(colours_by({{"scale", {1, -1}}, {"offset", {0, 1}}}), (std::array{blue, white, green}));
  constexpr double quarter = 1.57079632679;
  EXPECT_EQ(colours_by({{"offset", {0, 1}}, {"rotation", quarter}}),
            (std::array{blue, red, green}));
  picture["extensions"]["KHR_texture_transform"] = {{"rotation", "much"}};
  EXPECT_NE(refusal("b.glb", pair.bytes()).find("a finite number is wanted"), std::string::npos);
}

TEST_F(ColouredFiles, TrianglesAreThoseOfTheMesh) {
  const std::string text =
      "v 0 0 0 0 0 0\nv 1 0 0 1 0 0\nv 1 1 0 1 1 0\nv 0 1 0 0 1 0\nv 0.5 0.5 1 0.5 0.5 1\n"
      "f 1 2 3 4\nf 5 1 2\nf 5 2 3\n";
  const SurfaceColours colours = read("a.obj", text);
  const TriangleMesh mesh = read_mesh(folder_ / "a.obj");
  ASSERT_EQ(colours.part_of.size(), mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(colours.corners[t][k],
                linear_colour(vec_cast<float>(mesh.positions[mesh.triangles[t][k]])));
}

TEST(TexturePictures, RepeatOrGoOnBeyondTheirBorder) {
  SurfaceColours colours;
  colours.pictures = {decode_texture(four_texels, "four")};
  EXPECT_EQ(colours.pictures[0].rgb,
            (std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}));
  colours.parts = {{{1, 1, 1}, 0, false}, {{1, 1, 1}, 0, true}};
  colours.part_of = {0, 1};
  colours.uv = {{Vec2f{1.25F, 1.75F}, {}, {}}, {Vec2f{1.25F, 1.75F}, {}, {}}};
  EXPECT_EQ(display_bytes(colours.at(0, first)), (Bytes{255, 0, 0}));
  EXPECT_EQ(display_bytes(colours.at(1, first)), (Bytes{0, 255, 0}));
}

TEST(TexturePictures, OfSixteenBitsAreAsBrightAsOfEight) {
  EXPECT_EQ(decode_texture(deep_texel, "deep").rgb, (std::vector<std::uint8_t>{100, 200, 50}));
}

TEST(WriteColours, ComeBackFromPlyAndObj) {
  const test::TemporaryFolder folder;
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  std::vector<Vec3f> colours;
  for (const Bytes& c : {Bytes{1, 2, 3}, Bytes{100, 200, 77}, Bytes{255, 0, 128}})
    colours.push_back(linear_colour((1 / 255.0F) * Vec3f{float(c[0]), float(c[1]), float(c[2])}));
  for (const char* name : {"a.ply", "a.obj"}) {
    write_mesh(folder / name, mesh, colours);
    const SurfaceColours found = read_colours(folder / name);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(display_bytes(found.corners[0][k]), display_bytes(colours[k])) << name;
    EXPECT_EQ(read_mesh(folder / name).positions, mesh.positions);
  }
}

}  // namespace
}  // namespace weft
