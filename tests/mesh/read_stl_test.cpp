#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/errors.h"
#include "tests/support/meshes.h"
#include "weft/mesh.h"

namespace weft::read_stl_test {
namespace {

TriangleMesh parse(const std::string& bytes) { return parse_stl(bytes, "a.stl"); }

std::string refusal(const std::string& bytes) {
  return test::message_of<InputError>([&] { parse(bytes); });
}

void put_float(std::string& bytes, float value) {
  std::string piece(4, '\0');
  std::memcpy(piece.data(), &value, 4);
  bytes += piece;
}

std::string with_count(std::string bytes, std::uint32_t count) {
  for (std::size_t i = 0; i < 4; ++i) bytes[80 + i] = static_cast<char>((count >> (8 * i)) & 0xffU);
  return bytes;
}

std::string binary(const TriangleMesh& mesh, std::string title) {
  title.resize(84, ' ');
  std::string bytes = with_count(title, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const Triangle& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) put_float(bytes, 0);
    for (const int v : t) {
      const Vec3d p = mesh.positions[v];
      for (const double x : {p.x, p.y, p.z}) put_float(bytes, static_cast<float>(x));
    }
    bytes += std::string(2, '\0');
  }
  return bytes;
}

std::string text(const TriangleMesh& mesh) {
  std::string result = "solid by hand\n";
  for (const Triangle& t : mesh.triangles) {
    result += "  facet normal 0 0 1\n    outer loop\n";
    for (const int v : t) {
      const Vec3d p = mesh.positions[v];
      result += "      vertex " + std::to_string(p.x) + " " + std::to_string(p.y) + " " +
                std::to_string(p.z) + "\n";
    }
    result += "    endloop\n  endfacet\n";
  }
  return result + "endsolid by hand\n";
}

TEST(ReadStl, BinaryAndTextJoinTheSameVertices) {
  const TriangleMesh wanted = test::tetrahedron();
  for (const std::string& bytes :
       {binary(wanted, "a title"), binary(wanted, "solid is what many binary files begin with"),
        text(wanted)}) {
    const TriangleMesh mesh = parse(bytes);
    ASSERT_EQ(mesh.positions.size(), 4U);
    ASSERT_EQ(mesh.triangles.size(), 4U);
    for (std::size_t t = 0; t < 4; ++t)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(mesh.positions[mesh.triangles[t][k]], wanted.positions[wanted.triangles[t][k]]);
  }
}

TEST(ReadStl, CountThatDoesNotMatchTheSizeIsRefused) {
  const std::string whole = binary(test::tetrahedron(), "title");
  EXPECT_EQ(refusal(with_count(whole, 4000000000U)),
            "a.stl: is 284 bytes long where its facet count asks for 200000000084; a whole STL "
            "file, text (solid ...) "
            "or binary, is wanted");
  EXPECT_FALSE(refusal(with_count(whole, 3)).empty());
}

TEST(ReadStl, EveryCutIsNoticed) {
  const std::string text_file = text(test::tetrahedron());
  for (const std::string& whole :
       {binary(test::tetrahedron(), "title"), text_file.substr(0, text_file.find(" by hand", 20))})
    for (std::size_t size = 0; size < whole.size(); ++size)
      EXPECT_FALSE(refusal(whole.substr(0, size)).empty()) << "cut after " << size << " bytes";
}

TEST(ReadStl, BadTextLinesAreRefusedWithTheirNumber) {
  const auto expect = [](const std::string& body, const std::string& wanted) {
    EXPECT_EQ(refusal("solid a\n" + body).substr(0, wanted.size()), wanted);
  };
  const std::string open = "facet normal 0 0 1\nouter loop\n";
  expect(open + "vertex 0 0\n", "a.stl:4: the line ends before three coordinates");
  expect(open + "vertex 0 0 inf\n", "a.stl:4: coordinate 'inf' is not finite");
  expect(open + "vertex 0 0 1\nendloop\n", "a.stl:5: a facet with 1 vertices");
  expect(open + "vertex 0 0 1\nouter loop\n", "a.stl:5: 'outer' inside a loop");
  expect(open + "vertex 0 0 1\nendsolid\n", "a.stl:5: 'endsolid' inside a loop");
  expect("words\n", "a.stl:2: the line begins with 'words'");
  expect("", "a.stl:1: the file ends inside a solid");
  expect("endsolid\n", "a.stl: has no vertices");
}

TEST(ReadStl, WhatIsNoMeshIsRefusedInOneLine) {
  EXPECT_EQ(refusal(""), "a.stl: is empty; an STL mesh is wanted");
  EXPECT_NE(refusal("Dear reader,\nthis is a letter.\n").find("begins with 'Dear reader,'"),
            std::string::npos);
  std::string bytes = binary(test::tetrahedron(), "title");
  std::string nan;
  put_float(nan, std::numeric_limits<float>::quiet_NaN());
  bytes.replace(84 + 50 + 12, 4, nan);
  EXPECT_EQ(refusal(bytes).substr(0, 45), "a.stl: a coordinate of facet 1 is not finite;");
}

}  // namespace
}  // namespace weft::read_stl_test
