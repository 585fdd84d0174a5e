#include <cstring>

#include <gtest/gtest.h>

#include "tests/run/exported_runs.h"
#include "tests/support/convert_options.h"
#include "weft/convert.h"
#include "weft/files.h"
#include "weft/image/io/exr_codec.h"
#include "weft/mesh.h"
#include "weft/mesh_colours.h"

namespace weft {
namespace {

using test::as_floats;
using test::ExportedRun;
using test::sized;
using test::thrown_ring;
using test::exported_frames;

TEST(Exports, ObjIsFrameZeroOfTheCache) {
  const ExportedRun run(thrown_ring());
  const TriangleMesh mesh = read_mesh(run.folder / "ring.obj");
  EXPECT_EQ(as_floats(mesh.positions), run.points(0));
  EXPECT_EQ(mesh.corner_uv.size(), mesh.triangles.size());
  const std::string text = read_file(run.folder / "ring.obj");
  int normals = 0;
  for (std::size_t at = text.find("\nvn "); at != text.npos; at = text.find("\nvn ", at + 1))
    ++normals;
  EXPECT_EQ(normals, 256);
}

TEST(Exports, PlyAndGlbHaveTheColoursOfTheImage) {
  Scene scene = thrown_ring();
  GeometryImage image = load_surface({"builtin:torus"}, sized(17)).image;
  image.colours = Planes3(17);
  const auto colour = [](const GeometryImage& of, int sample) {
    const Vec3f p = of.cube.at(sample);  // exact in single precision, as GLB has it
    return Vec3f{p.x, 1 - p.y, 0.5F};
  };
  for (int s = 0; s < 17 * 17; ++s)
    image.colours.set(s, colour(image, image.mates.representative(s)));
  scene.cloths[0].surface = Surface(image, "ring");
  const ExportedRun run(scene, WrittenOn::image);
  const RebuiltMesh rebuilt = rebuild_mesh(image);
  const std::vector<Vec3f> wanted = vertex_colours(image, rebuilt);
  for (const char* name : {"ring_ply/ring_0002.ply", "ring.glb"}) {
    const TriangleMesh mesh = read_mesh(run.folder / name);
    const SurfaceColours found = read_colours(run.folder / name);
    ASSERT_EQ(mesh.triangles.size(), rebuilt.mesh.triangles.size()) << name;
    for (std::size_t t = 0; t < rebuilt.mesh.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        ASSERT_EQ(display_bytes(found.corners[t][k]),
                  display_bytes(wanted[rebuilt.mesh.triangles[t][k]]))
            << name;
  }
}

TEST(Exports, MddHasTheSamePointsAndTheTimesInSeconds) {
  const ExportedRun run(thrown_ring());
  const PointCache mdd = read_point_cache(run.folder / "ring.mdd");
  EXPECT_EQ(mdd.points, 256);
  ASSERT_EQ(mdd.samples(), exported_frames + 1);
  EXPECT_FALSE(mdd.times_in_frames);
  EXPECT_FLOAT_EQ(static_cast<float>(mdd.times[3]), 3 / 60.0F);
  EXPECT_EQ(mdd.positions, run.cache.positions);
}

TEST(Exports, EveryFrameIsAPly) {
  const ExportedRun run(thrown_ring());
  for (int frame = 0; frame <= exported_frames; ++frame) {
    const TriangleMesh mesh =
        read_mesh(run.folder / ("ring_ply/ring_000" + std::to_string(frame) + ".ply"));
    EXPECT_EQ(as_floats(mesh.positions), run.points(frame));
    EXPECT_EQ(mesh.triangles.size(), 512);
  }
  EXPECT_FALSE(std::filesystem::exists(run.folder / "ring_ply/ring_0004.ply"));
}

TEST(Exports, EveryFrameIsAnExrOfTheSamplesBitForBit) {
  const ExportedRun run(thrown_ring());
  Simulation again(thrown_ring(), "scene.json", 1);
  for (int frame = 0; frame <= exported_frames; ++frame) {
    const std::string name = "ring_exr/ring_000" + std::to_string(frame) + ".exr";
    const DecodedImage image = decode_exr(read_file(run.folder / name), name);
    ASSERT_EQ(image.planes.size(), 17);
    for (int s = 0; s < 17 * 17; ++s)
      EXPECT_EQ(image.planes.at(s), again.cloths()[0].state.position.at(s));
    again.advance();
  }
}

/// The value of an attribute, found by hand: appended bytes are no XML.
std::string attribute(const std::string& text, std::size_t from, const std::string& name) {
  const std::size_t begin = text.find(name + "=\"", from) + name.size() + 2;
  return text.substr(begin, text.find('"', begin) - begin);
}

TEST(Exports, EveryFrameIsAVtpAndThePvdListsThemByTime) {
  const ExportedRun run(thrown_ring());
  const std::string vtp = read_file(run.folder / "ring_vtp/ring_0002.vtp");
  const std::size_t data = vtp.find("<AppendedData");
  const std::size_t begin = vtp.find('_', data) + 1;
  const std::size_t offset =
      std::stoul(attribute(vtp, vtp.find("Name=\"Points\""), "offset")) + begin;
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, vtp.data() + offset, sizeof(bytes));
  ASSERT_EQ(bytes, 256 * sizeof(Vec3f));
  std::vector<Vec3f> points(256);
  std::memcpy(points.data(), vtp.data() + offset + sizeof(bytes), bytes);
  EXPECT_EQ(points, run.points(2));
  EXPECT_EQ(attribute(vtp, 0, "NumberOfPolys"), "512");
  const std::string pvd = read_file(run.folder / "ring.pvd");
  const std::size_t second = pvd.find("ring_vtp/ring_0002.vtp");
  ASSERT_NE(second, pvd.npos);
  const std::string time = attribute(pvd, pvd.rfind("timestep", second), "timestep");
  EXPECT_NEAR(std::stod(time), 2 / 60.0, 1e-12);
  EXPECT_EQ(pvd.find("ring_0004.vtp"), pvd.npos);
}

/// Checks brackets and quotes, and gives the text without what is in quotes.
std::string unquoted(const std::string& text) {
  std::string bare, open;
  bool quoted = false;
  for (const char c : text) {
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    bare.push_back(c);
    if (c == '{' || c == '[' || c == '(') open.push_back(c);
    const std::string pairs = "{}[]()";
    const std::size_t at = pairs.find(c);
    if (at != pairs.npos && at % 2 == 1) {
      EXPECT_FALSE(open.empty() || open.back() != pairs[at - 1]);
      if (!open.empty()) open.pop_back();
    }
  }
  EXPECT_TRUE(open.empty() && !quoted);
  return bare;
}

std::size_t count(const std::string& text, const std::string& what, std::size_t from,
                  std::size_t to) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what, from); at < to; at = text.find(what, at + 1)) ++found;
  return found;
}

TEST(Exports, UsdaIsBalancedAndHasASampleForEveryFrame) {
  const ExportedRun run(thrown_ring());
  const std::string text = read_file(run.folder / "ring.usda");
  EXPECT_TRUE(text.starts_with("#usda 1.0\n("));
  for (const char* line : {"upAxis = \"Y\"", "metersPerUnit = 1", "timeCodesPerSecond = 60",
                           "endTimeCode = 3", "def Mesh", "int[] faceVertexCounts = [3, 3,"})
    EXPECT_NE(text.find(line), text.npos) << line;
  const std::string bare = unquoted(text);
  const std::size_t points = bare.find("points.timeSamples"),
                    normals = bare.find("normals.timeSamples");
  ASSERT_TRUE(points < normals && normals != bare.npos);
  EXPECT_EQ(count(bare, "(", points, bare.find("normal3f[]")), 256 * (exported_frames + 1));
  EXPECT_EQ(count(bare, "(", normals, bare.size()), 256 * (exported_frames + 1));
  EXPECT_NE(bare.find("\n            3: ["), bare.npos);
  const Vec3f first = run.points(0)[0];
  const std::size_t begin = text.find("0: [(", text.find("points.timeSamples")) + 5;
  EXPECT_EQ(std::stof(text.substr(begin)), first.x);
}

}  // namespace
}  // namespace weft
