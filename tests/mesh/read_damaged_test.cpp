#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/mesh/gltf_files.h"
#include "weft/core/random.h"
#include "weft/error.h"
#include "weft/mesh.h"
#include "weft/repair.h"

namespace weft {
namespace {

using Parser = TriangleMesh (*)(std::string_view, std::string_view);

TriangleMesh parse_glb(std::string_view bytes, std::string_view name) {
  return parse_gltf(bytes, name);
}

struct Sample {
  const char* name;
  Parser parser;
  std::string bytes;
};

std::vector<Sample> samples() {
  const std::string obj =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nf 1/1 3/1 2/1\nf -4 2 4\nf 1 4 3\n";
  const std::string off = "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  std::string binary_ply = ply.substr(0, ply.find("end_header\n") + 11);
  binary_ply.replace(binary_ply.find("ascii"), 5, "binary_little_endian");
  binary_ply += std::string(24, '\0') + std::string("\0\0\x80\x3f", 4) + std::string(8, '\0') +
                std::string("\3\0\0\0\0\1\0\0\0\2\0\0\0", 13);
  std::string strips = ply;
  strips.replace(strips.find("element face"), 12, "element tristrips");
  strips.replace(strips.size() - 8, 8, "7 0 1 2 -1 2 1 0\n");
  std::string wide_obj = "\xff\xfe";
  for (const char c : obj) wide_obj += {c, '\0'};
  const std::string stl =
      "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
      "endfacet\nendsolid\n";
  std::string binary_stl(84 + 50, '\0');
  binary_stl[80] = 1;
  return {{"a.obj", parse_obj, obj},
          {"b.obj", parse_obj, wide_obj},
          {"a.off", parse_off, off},
          {"a.ply", parse_ply, ply},
          {"b.ply", parse_ply, binary_ply},
          {"c.ply", parse_ply, strips},
          {"a.stl", parse_stl, stl},
          {"b.stl", parse_stl, binary_stl},
          {"b.glb", parse_glb, test::CreasedPair{}.bytes()}};
}

void damage(std::string& bytes, Random& random) {
  const std::string spice = "0123456789-+.e/ \n\r\t#fvx\xff";
  const auto at = static_cast<std::size_t>(random.index(static_cast<int>(bytes.size())));
  const char c = random.uniform() < 0.7 ? spice[random.index(static_cast<int>(spice.size()))]
                                        : static_cast<char>(random.index(256));
  const double kind = random.uniform();
  if (kind < 0.6)
    bytes[at] = c;
  else if (kind < 0.8)
    bytes.insert(at, 1, c);
  else if (kind < 0.95)
    bytes.erase(at, 1 + random.index(4));
  else
    bytes.resize(at + 1);
}

void expect_sound(const TriangleMesh& mesh) {
  EXPECT_FALSE(mesh.triangles.empty());
  for (const Vec3d& p : mesh.positions)
    EXPECT_LE(std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}), 1e30);
  for (const Triangle& t : mesh.triangles)
    for (const int v : t) EXPECT_TRUE(v >= 0 && v < static_cast<int>(mesh.positions.size()));
}

/// Whatever is done to a file, it gives a mesh in order or one line that names the file.
TEST(ReadDamaged, MeshInOrderOrOneLineWithTheName) {
  for (const Sample& sample : samples()) {
    ASSERT_NO_THROW(sample.parser(sample.bytes, sample.name)) << sample.name;
    int accepted = 0, refused = 0;
    for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
      Random random(seed);
      std::string bytes = sample.bytes;
      for (int i = random.index(4); i >= 0; --i)
        if (!bytes.empty()) damage(bytes, random);
      try {
        const TriangleMesh mesh = sample.parser(bytes, sample.name);
        expect_sound(mesh);
        repair_mesh(mesh, {sample.name, {}});
        ++accepted;
      } catch (const Error& error) {
        const std::string line = error.what();
        EXPECT_EQ(line.substr(0, 5), sample.name) << line;
        EXPECT_EQ(line.find_first_of("\r\n"), line.npos) << line;
        ++refused;
      }
    }
    EXPECT_GT(accepted, 0) << sample.name;
    EXPECT_GT(refused, 0) << sample.name;
  }
}

}  // namespace
}  // namespace weft
