#include <gtest/gtest.h>

#include "tests/support/errors.h"
#include "weft/mesh.h"

namespace weft::read_off_test {
namespace {

using Triangles = std::vector<Triangle>;

TriangleMesh parse(const std::string& text) { return parse_off(text, "a.off"); }

std::string refusal(const std::string& text) {
  return test::message_of<InputError>([&] { parse(text); });
}

TEST(ReadOff, VerticesFacesCommentsAndBlankLines) {
  const TriangleMesh mesh = parse(
      "# made by hand\nOFF\r\n4 2 0 # edges are not counted\n\n0 0 0\n1 0 0\n 1 1 0 \n"
      "# the last\n0 1e0 -0.5\n3 0 1 2\n3 0 2 3 255 0 0\n");
  EXPECT_EQ(mesh.positions, (std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, -0.5}}));
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(ReadOff, CountsMayStandBesideTheKeywordAndVerticesHaveColoursAndNormals) {
  const TriangleMesh mesh = parse(
      "CNOFF 4 1\n0 0 0 0 0 1 9 9 9\n1 0 0 0 0 1 9 9 9\n1 1 0 0 0 1 9 9 9\n0 1 0 0 0 1 9 9 9\n"
      "4 0 1 2 3\n");
  EXPECT_EQ(mesh.positions.size(), 4U);
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(ReadOff, VerticesAndFacesMayGoOnOnTheNextLine) {
  const TriangleMesh mesh = parse(
      "COFF # colours\n4\n2 # no edges\n0 0 # z follows\n 0 9 9 9\n\n1\n0\n0\n1 1 0 9 9 9\n0 1 0\n"
      "3 0 1 2 0.5 0.5 0.5\n3 0\n# between\n 2\n3 255 0 0\n");
  EXPECT_EQ(mesh.positions, (std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(ReadOff, NumbersMayHaveALineEach) {
  const TriangleMesh mesh = parse("OFF\n3\n1\n0\n5\n6\n7\n1\n0\n0\n0\n1\n0\n3\n0\n1\n2\n");
  EXPECT_EQ(mesh.positions, (std::vector<Vec3d>{{5, 6, 7}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}}));
}

TEST(ReadOff, EveryKeywordMayHaveTheCountsBesideIt) {
  for (const char* keyword : {"OFF", "COFF", "NOFF", "STOFF", "STCNOFF"})
    for (const char* apart : {" ", "\n", " # made by hand\n"})
      EXPECT_EQ(parse(std::string(keyword) + apart +
                      "3 1 3\n0 0 0 1 1 1\n1 0 0 1 1 1\n0 1 0 1 1 1\n3 0 1 2\n")
                    .triangles,
                (Triangles{{0, 1, 2}}))
          << keyword << apart;
}

TEST(ReadOff, BinaryIsRefusedByName) {
  for (const char* keyword : {"OFF", "COFF"})
    EXPECT_EQ(refusal(keyword + std::string(" BINARY\n\0\0\0\4\0\0\0\2", 16)),
              "a.off:1: is binary OFF; OFF as text is wanted");
}

TEST(ReadOff, PointsAloneAreNoSurface) {
  EXPECT_EQ(refusal("OFF\n2 0 0\n0 0 0\n1 1 1\n"),
            "a.off: holds points only: 2 vertices and no faces; a surface of triangles is wanted");
}

TEST(ReadOff, BadLinesAreRefusedWithTheirNumber) {
  const auto expect = [](const std::string& text, const std::string& wanted) {
    EXPECT_EQ(refusal(text).substr(0, wanted.size()), wanted);
  };
  const std::string head = "OFF\n3 1 0\n", points = "0 0 0\n1 0 0\n0 1 0\n";
  expect("Dear reader,\n", "a.off:1: begins with 'Dear'");
  expect("4OFF\n", "a.off:1: begins with '4OFF'");
  expect("OFF\n", "a.off:1: the file ends before the counts");
  expect("OFF\n3\n", "a.off:2: the file ends before the face count");
  expect("OFF\n0 0 0\n", "a.off: has no vertices");
  expect("OFF\n-3 1 0\n" + points, "a.off:2: the vertex count is '-3'");
  expect("OFF\n4000000000 1 0\n" + points, "a.off:2: the vertex count is '4000000000'");
  expect("OFF\n600000000 1 0\n" + points, "a.off:2: 600000000 vertices and 1 faces cannot fit");
  expect(head + "0 0 0\n1 0\n0 1 0\n3 0 1 2", "a.off:6: the file ends after 0 of 1 faces");
  expect("OFF\n3 0 0\n0 0 0 0 0 0\n1 0\n", "a.off:4: the file ends before three coordinates");
  expect(head + "0 0 0\n1 0 nan\n0 1 0\n3 0 1 2", "a.off:4: coordinate 'nan' is not finite");
  expect(head, "a.off:2: 3 vertices and 1 faces cannot fit into the 0 bytes");
  expect(head + points, "a.off:5: the file ends after 0 of 1 faces");
  expect(head + "0.25 0.25 0.25\n1 0 0\n# end\n", "a.off:5: the file ends after 2 of 3 vertices");
  expect(head + points + "# no face\n", "a.off:6: the file ends after 0 of 1 faces");
  expect(head + points + "3 0 1\n", "a.off:6: the file ends before a vertex index");
  expect(head + points + "3 0 1 3\n", "a.off:6: a vertex index is '3'");
  expect(head + points + "3 0 1 -1\n", "a.off:6: a vertex index is '-1'");
  expect(head + points + "2 0 1\n", "a.off:6: the number of corners is '2'");
  expect(head + points + "600000000 0 1 2\n", "a.off:6: the file ends before a vertex index");
  expect(head + points + "3 0 1 2\n3 2 1 0\n", "a.off:7: content behind the last face");
}

TEST(ReadOff, EveryCutIsNoticed) {
  const std::string whole = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
  ASSERT_EQ(parse(whole).triangles.size(), 2U);
  for (std::size_t size = 0; size + 1 < whole.size(); ++size)
    EXPECT_FALSE(refusal(whole.substr(0, size)).empty()) << "cut after " << size << " bytes";
}

}  // namespace
}  // namespace weft::read_off_test
