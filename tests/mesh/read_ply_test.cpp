#include <cstring>

#include <gtest/gtest.h>

#include "tests/support/errors.h"
#include "weft/mesh.h"

namespace weft::read_ply_test {
namespace {

using Triangles = std::vector<Triangle>;

TriangleMesh parse(const std::string& bytes) { return parse_ply(bytes, "a.ply"); }

std::string refusal(const std::string& bytes) {
  return test::message_of<InputError>([&] { parse(bytes); });
}

std::string header(const std::string& format, int vertices, int faces,
                   const std::string& real = "float") {
  return "ply\nformat " + format + " 1.0\ncomment made by hand\nelement vertex " +
         std::to_string(vertices) + "\nproperty " + real + " x\nproperty " + real +
         " y\nproperty " + real + " z\nproperty uchar red\nelement face " + std::to_string(faces) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

const std::string text_square =
    header("ascii", 4, 2) + "0 0 0 255\n1 0 0 255\n1 1 0 255\n0 1 0.5 255\n3 0 1 2\n3 0 2 3\n";

/// Appends a value in either byte order.
template <class T>
void put(std::string& bytes, T value, bool big) {
  std::string piece(sizeof(T), '\0');
  std::memcpy(piece.data(), &value, sizeof(T));
  if (big) piece.assign(piece.rbegin(), piece.rend());
  bytes += piece;
}

template <class Real>
std::string binary_square(bool big) {
  std::string bytes = header(big ? "binary_big_endian" : "binary_little_endian", 4, 2,
                             sizeof(Real) == 4 ? "float32" : "double");
  for (const Vec3d p : {Vec3d{0, 0, 0}, Vec3d{1, 0, 0}, Vec3d{1, 1, 0}, Vec3d{0, 1, 0.5}}) {
    for (const double x : {p.x, p.y, p.z}) put(bytes, static_cast<Real>(x), big);
    put(bytes, std::uint8_t{255}, big);
  }
  for (const Triangle& t : Triangles{{0, 1, 2}, {0, 2, 3}}) {
    put(bytes, std::uint8_t{3}, big);
    for (const int v : t) put(bytes, std::int32_t{v}, big);
  }
  return bytes;
}

TEST(ReadPly, TextAndBothByteOrdersGiveTheSameMesh) {
  const TriangleMesh mesh = parse(text_square);
  EXPECT_EQ(mesh.positions, (std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5}}));
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  for (const bool big : {false, true}) {
    for (const std::string& bytes : {binary_square<float>(big), binary_square<double>(big)}) {
      EXPECT_EQ(parse(bytes).positions, mesh.positions);
      EXPECT_EQ(parse(bytes).triangles, mesh.triangles);
    }
  }
}

TEST(ReadPly, OtherElementsAndListsAreSteppedOver) {
  const std::string text =
      "ply\r\nformat ascii 1.0\r\nelement camera 1\r\nproperty float fov\r\n"
      "property list int float lens\r\nelement face 1\r\nproperty uchar flags\r\n"
      "property list uchar uint vertex_index\r\nelement vertex 4\r\nproperty double z\r\n"
      "property double x\r\nproperty list uchar int seen\r\nproperty double y\r\nend_header\r\n"
      "45 2 1.5 2.5\r\n7 4 0 1 2 3\r\n9 0 0 0\r\n9 1 1 5 0\r\n9 1 2 5 6 1\r\n9 0 0 1\r\n";
  const TriangleMesh mesh = parse(text);
  EXPECT_EQ(mesh.positions, (std::vector<Vec3d>{{0, 0, 9}, {1, 0, 9}, {1, 1, 9}, {0, 1, 9}}));
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(ReadPly, BadHeadersAreRefusedWithTheirLine) {
  const auto expect = [](const std::string& text, const std::string& wanted) {
    EXPECT_EQ(refusal(text).substr(0, wanted.size()), wanted);
  };
  expect("", "a.ply: is empty");
  expect("Dear reader,\n", "a.ply:1: begins with 'Dear'");
  expect("\x89PNG\r\n\x1a\n", "a.ply:1: begins with '?PNG'");
  expect("ply\nformat ascii 1.0\nelement vertex 3\n", "a.ply:3: the file ends inside the header");
  expect("ply\nformat binary 1.0\n", "a.ply:2: format 'binary'");
  expect("ply\nproperty float x\n", "a.ply:2: a property before any element");
  expect("ply\nelement vertex many\n", "a.ply:2: the number of 'vertex' is 'many'");
  expect("ply\nelement vertex -1\n", "a.ply:2: the number of 'vertex' is '-1'");
  expect("ply\nelement vertex 4000000000\n", "a.ply:2: the number of 'vertex' is '4000000000'");
  expect("ply\nelement vertex 1\nproperty half x\n", "a.ply:3: property type 'half'");
  expect("ply\nelement vertex 1\nproperty list float int x\n", "a.ply:3: a list whose length");
  expect("ply\nsurprise\n", "a.ply:2: the file ends inside the header");
  expect("ply\nelement vertex 5\nend_header\n", "a.ply:3: element 'vertex' has no properties");
  expect("ply\nformat ascii 1.0\nend_header\n", "a.ply: has no element vertex");
  expect("ply\nelement vertex 0\nproperty float x\nproperty float y\nend_header\n",
         "a.ply: its vertices lack x, y or z");
  expect(header("ascii", 600000000, 2) + "0 0 0 0\n",
         "a.ply:11: 600000000 of 'vertex' cannot fit into the 8 bytes that follow");
  expect(header("binary_little_endian", 3, 600000000) + std::string(100, '\0'),
         "a.ply:11: 600000000 of 'face' cannot fit into the 100 bytes that follow");
}

TEST(ReadPly, BadTextLinesAreRefusedWithTheirNumber) {
  const auto expect = [](const std::string& body, const std::string& wanted) {
    const std::string message = refusal(header("ascii", 3, 1) + body);
    EXPECT_EQ(message.substr(0, wanted.size()), wanted);
  };
  const std::string points = "0 0 0 1\n1 0 0 1\n0 1 0 1\n";
  expect("0 0 0 1\n1 0 0\n0 1 0 1\n3 0 1 2\n", "a.ply:13: the line ends before all properties");
  expect("0 0 0 1\n1 0 0 1 1\n0 1 0 1\n3 0 1 2\n", "a.ply:13: more values in the line");
  expect("0 0 0 1\n1 0 up 1\n0 1 0 1\n3 0 1 2\n", "a.ply:13: 'up' is not a number");
  expect("0 0 0 1\n1 0 nan 1\n0 1 0 1\n3 0 1 2\n", "a.ply:13: coordinate z is not finite");
  expect("0 0 0 1\n1 0 1e31 1\n0 1 0 1\n3 0 1 2\n", "a.ply:13: coordinate z is larger");
  expect(points + "3 0 1 3\n", "a.ply:15: a face uses vertex 3 of 3");
  expect(points + "3 0 1 -1\n", "a.ply:15: a face uses vertex -1 of 3");
  expect(points + "3 0 1 0.5\n", "a.ply:15: '0.5' is not a number of the announced type");
  expect(points + "2 0 1\n", "a.ply:15: a face with 2 corners");
  expect(points + "-1 0 1\n", "a.ply:15: a list of negative length");
  expect(points + "255 0 1 2\n", "a.ply:15: the line ends before all properties");
  expect(points + "3 0 1 2\n3 0 1 2\n", "a.ply:16: content behind the last element");
  expect(points + "# nothing\n", "a.ply:15: the file ends after 0 of 1 of 'face'");
}

TEST(ReadPly, EveryCutIsNoticed) {
  for (const std::string& whole : {text_square.substr(0, text_square.size() - 1),
                                   binary_square<float>(false), binary_square<double>(true)}) {
    ASSERT_EQ(parse(whole).triangles.size(), 2U);
    for (std::size_t size = 0; size < whole.size(); ++size)
      EXPECT_FALSE(refusal(whole.substr(0, size)).empty()) << "cut after " << size << " bytes";
  }
}

TEST(ReadPly, BinaryErrorsNameTheItem) {
  std::string bytes = binary_square<float>(false);
  bytes[bytes.size() - 4] = 9;
  EXPECT_NE(refusal(bytes).find("element 'face' 1: a face uses vertex 9 of 4"), std::string::npos);
  EXPECT_NE(refusal(binary_square<float>(false) + "more").find("content behind"),
            std::string::npos);
}

TEST(ReadPly, CloudOfPointsIsNoSurface) {
  EXPECT_EQ(refusal(header("ascii", 2, 0) + "0 0 0 0\n1 1 1 1\n"),
            "a.ply: holds points only: 2 vertices and no faces; a surface of triangles is wanted");
}

TEST(ReadPly, EdgesAloneAreNoSurface) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
      "property float z\nelement edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n"
      "0 0 0\n1 1 1\n0 1\n";
  EXPECT_EQ(refusal(text),
            "a.ply: holds lines only: 2 vertices and no faces; a surface of triangles is wanted");
}

TEST(ReadPly, StrayHeaderLinesAreSteppedOver) {
  const std::string text =
      "ply \r\ncomment before the format\r\nformat ascii 1.0  \r\n\r\nmodified by a program\r\n"
      "element vertex 3 \r\nproperty float x\t\r\nproperty float y\r\n  \r\nproperty float z\r\n"
      "material 7\r\nelement face 1\r\n# a remark\r\nproperty list uchar int vertex_indices\r\n"
      "end_header \r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n3 0 1 2\r\n";
  EXPECT_EQ(parse(text).triangles, (Triangles{{0, 1, 2}}));
  std::string bytes = binary_square<float>(false);
  bytes.insert(bytes.find("element face"), "\nrevision 3\r\n \n");
  EXPECT_EQ(parse(bytes).triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(ReadPly, HeaderLinesThatMayChangeTheLayoutAreRefused) {
  for (const std::string line :
       {"Element vertex 3", "PROPERTY float x", "propert float x", "prop list uchar int seen"}) {
    const std::string keyword = line.substr(0, line.find(' '));
    EXPECT_EQ(refusal("ply\nformat ascii 1.0\n" + line + "\nend_header\n"),
              "a.ply:3: header line '" + keyword + "'; element, property or end_header is wanted");
  }
}

/// Five vertices in two strips, apart by -1. The second begins with a degenerate triangle.
const std::vector<int> two_strips{0, 1, 2, 3, -1, 2, 2, 4, 3, -1};
const Triangles two_strips_triangles{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}};

std::string strips_header(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
         "element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
}

std::string text_strips(const std::string& list) {
  return strips_header("ascii") + "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n" + list + "\n";
}

std::string binary_strips(bool big) {
  std::string bytes = strips_header(big ? "binary_big_endian" : "binary_little_endian");
  for (const float x : {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}) put(bytes, x, big);
  put(bytes, static_cast<std::int32_t>(two_strips.size()), big);
  for (const int v : two_strips) put(bytes, std::int32_t{v}, big);
  return bytes;
}

TEST(ReadPly, StripsBecomeTrianglesThatFaceOneWay) {
  std::string list = std::to_string(two_strips.size());
  for (const int v : two_strips) list += " " + std::to_string(v);
  const TriangleMesh mesh = parse(text_strips(list));
  EXPECT_EQ(mesh.triangles, two_strips_triangles);
  for (const auto& [a, b, c] : mesh.triangles)
    EXPECT_GT(cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]).z,
              0);
  for (const bool big : {false, true}) {
    EXPECT_EQ(parse(binary_strips(big)).positions, mesh.positions);
    EXPECT_EQ(parse(binary_strips(big)).triangles, mesh.triangles);
  }
}

TEST(ReadPly, StripsMayLackTheLastMarkAndBeTooShortForATriangle) {
  EXPECT_EQ(parse(text_strips("3 2 1 0")).triangles, (Triangles{{2, 1, 0}}));
  EXPECT_EQ(parse(text_strips("9 -1 0 1 -1 2 -1 0 1 2")).triangles, (Triangles{{0, 1, 2}}));
  EXPECT_NE(refusal(text_strips("3 0 0 1")).find("no faces"), std::string::npos);
}

TEST(ReadPly, BadStripsAreRefused) {
  const auto expect = [](const std::string& list, const std::string& wanted) {
    EXPECT_EQ(refusal(text_strips(list)).substr(0, wanted.size()), wanted);
  };
  expect("3 0 1 5", "a.ply:15: a face uses vertex 5 of 5");
  expect("3 0 1 -2", "a.ply:15: a face uses vertex -2 of 5");
  expect("2000000000 0 1 2", "a.ply:15: the line ends before all properties");
  const std::string whole = binary_strips(true);
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(refusal(whole.substr(0, size)).empty()) << "cut after " << size << " bytes";
  std::string other = text_strips("3 0 1 2");
  other.replace(other.find("vertex_indices"), 14, "corners");
  EXPECT_EQ(refusal(other),
            "a.ply: its strips have 0 lists of vertices; one list vertex_indices is wanted");
}

TEST(ReadPly, TextureCoordinatesOfVerticesComeUnderAllTheirNames) {
  const std::array<Vec2f, 3> expected{{{0, 0.5F}, {1, 0.25F}, {0.125F, 1}}};
  for (const auto& [u, v] : {std::pair{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}}) {
    const std::string text = std::string("ply\nformat ascii 1.0\nelement vertex 3\n") +
                             "property float " + v + "\nproperty float x\nproperty float y\n" +
                             "property float " + u + "\nproperty float z\nelement face 1\n" +
                             "property list uchar int vertex_indices\nend_header\n" +
                             "0.5 0 0 0 0\n0.25 1 0 1 0\n1 0 1 0.125 0\n3 0 1 2\n";
    const TriangleMesh mesh = parse(text);
    ASSERT_EQ(mesh.corner_uv.size(), 1U) << u;
    EXPECT_EQ(mesh.corner_uv[0], expected) << u;
    EXPECT_EQ(mesh.positions[1], (Vec3d{1, 0, 0}));
  }
  EXPECT_TRUE(parse(text_square).corner_uv.empty());
}

}  // namespace
}  // namespace weft::read_ply_test
