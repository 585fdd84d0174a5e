#include <functional>

#include <gtest/gtest.h>

#include "tests/mesh/gltf_files.h"
#include "tests/support/errors.h"
#include "weft/mesh.h"

namespace weft::read_encodings_test {
namespace {

using Parser = std::function<TriangleMesh(std::string_view)>;

const std::string obj = "# by hand\nv 0 0 0\nv 1 0 0\r\nv 0 1 0\nf 1 2 3\n";

struct Sample {
  const char* name;
  Parser parser;
  std::string text;
};

std::vector<Sample> samples() {
  return {
      {"OBJ", [](std::string_view bytes) { return parse_obj(bytes, "a.obj"); }, obj},
      {"OFF", [](std::string_view bytes) { return parse_off(bytes, "a.off"); },
       "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
      {"PLY", [](std::string_view bytes) { return parse_ply(bytes, "a.ply"); },
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
       "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
       "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
      {"STL", [](std::string_view bytes) { return parse_stl(bytes, "a.stl"); },
       "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
       "endloop\nendfacet\nendsolid a\n"},
  };
}

/// ASCII as UTF-16, with its byte-order mark.
std::string utf16(const std::string& text, bool big_endian) {
  std::string bytes = big_endian ? "\xfe\xff" : "\xff\xfe";
  for (const char c : text) bytes += big_endian ? std::string{'\0', c} : std::string{c, '\0'};
  return bytes;
}

void expect_the_triangle(const TriangleMesh& mesh, const char* name) {
  EXPECT_EQ(mesh.positions, (std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})) << name;
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}})) << name;
}

TEST(ReadEncodings, Utf8MayHaveItsMarkInEveryTextFormat) {
  for (const Sample& sample : samples())
    expect_the_triangle(sample.parser("\xef\xbb\xbf" + sample.text), sample.name);
  test::CreasedPair gltf;
  gltf.json["buffers"][0]["uri"] = "data:;base64," + std::string(112, 'A');
  EXPECT_EQ(parse_gltf("\xef\xbb\xbf" + json_text(gltf.json), "a.gltf").triangles.size(), 2U);
}

TEST(ReadEncodings, BinaryPlyMayHaveTheMarkToo) {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  expect_the_triangle(parse_ply("\xef\xbb\xbf" + ply_bytes(mesh), "a.ply"), "PLY");
}

TEST(ReadEncodings, Utf16OfBothByteOrdersGivesTheSameMesh) {
  for (const Sample& sample : samples())
    for (const bool big_endian : {false, true})
      expect_the_triangle(sample.parser(utf16(sample.text, big_endian)), sample.name);
  EXPECT_EQ(parse_obj_file(utf16(obj, false), "a.obj").faces.sizes, std::vector<int>{3});
}

TEST(ReadEncodings, Utf16ErrorsKeepTheirLine) {
  EXPECT_EQ(
      test::message_of<InputError>([] { parse_obj(utf16(obj + "f 1 2 4\n", true), "a.obj"); }),
      "a.obj:6: a face uses vertex 4 of 3; an existing vertex is wanted");
}

TEST(ReadEncodings, Utf16CommentsMayHoldAnything) {
  const std::string word("\x3d\xd8\x00\xde\xe4\x00\x0d\x20", 8);  // a smile, an umlaut, a joiner
  std::string bytes = utf16("# ", false) + word + utf16("\n" + obj, false).substr(2);
  expect_the_triangle(parse_obj(bytes, "a.obj"), "comment");
  bytes = utf16("v 0 0 0", false) + word + utf16("\n" + obj, false).substr(2);
  EXPECT_THROW(parse_obj(bytes, "a.obj"), InputError);  // in a number it does not vanish
}

TEST(ReadEncodings, EveryCutOfUtf16IsNoticed) {
  const Sample off = samples()[1];
  const std::string whole = utf16(off.text, true);
  for (std::size_t size = 0; size + 2 < whole.size(); ++size)
    EXPECT_THROW(off.parser(whole.substr(0, size)), InputError) << "cut after " << size;
  EXPECT_THROW(off.parser(whole.substr(0, whole.size() - 2) + "\n"), InputError);
}

TEST(ReadEncodings, WhatIsNoUtf16IsStillBinaryData) {
  for (const std::string& bytes :
       {utf16(obj, false).substr(2), std::string("\xff\xfe\0\0v\0\0\0", 8)})
    EXPECT_EQ(test::message_of<InputError>([&] { parse_obj(bytes, "a.obj"); }),
              "a.obj: holds binary data; an OBJ text file is wanted");
}

}  // namespace
}  // namespace weft::read_encodings_test
