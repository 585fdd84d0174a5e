// What is written of a garment: one mesh with its seams closed.
#include <algorithm>
#include <cstring>
#include <map>
#include <set>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <gtest/gtest.h>

#include "tests/run/exported_runs.h"
#include "tests/support/tube_scene.h"
#include "weft/garment.h"
#include "weft/mesh.h"
#include "weft/run/export/surface_points.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

using test::as_floats;
using test::ExportedRun;

constexpr double width = 30, height = 20;  // of the panels [cm]
constexpr int across = 12, along = 8;      // intervals of samples: multiples of four

/// A tube of two panels, sewn round a ball.
Scene tube(const fs::path& path, int frames) {
  Scene scene;
  scene.frames = frames;
  scene.ground.reset();
  scene.cloths = {test::tube_cloth(path, width, height, 0.03)};
  scene.bodies = {test::ball_in_tube(1.1, 17)};
  return scene;
}

class GarmentExports : public testing::Test {
 protected:
  const ExportedRun& run() {
    static const test::TemporaryFolder folder;
    static const ExportedRun done(tube(folder / "tube.json", 100));
    return done;
  }
};

/// How many triangles each edge has.
std::map<std::pair<int, int>, int> uses_of_edges(const std::vector<Triangle>& triangles) {
  std::map<std::pair<int, int>, int> uses;
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) ++uses[std::minmax(t[k], t[(k + 1) % 3])];
  return uses;
}

TEST_F(GarmentExports, MeshIsATubeWithTwoBorders) {
  const TriangleMesh mesh = read_mesh(run().folder / "tube.draped.obj");
  const auto uses = uses_of_edges(mesh.triangles);
  int border = 0;
  for (const auto& [edge, count] : uses) {
    EXPECT_LE(count, 2);
    border += count == 1 ? 1 : 0;
  }
  EXPECT_EQ(border, 2 * 2 * across) << "of two panels, at the top and at the bottom";
  const auto euler = static_cast<int>(mesh.positions.size()) - static_cast<int>(uses.size()) +
                     static_cast<int>(mesh.triangles.size());
  EXPECT_EQ(euler, 0);
}

TEST_F(GarmentExports, DrapedMeshIsTheLastFrameOfTheCache) {
  const TriangleMesh first = read_mesh(run().folder / "tube.obj");
  const TriangleMesh last = read_mesh(run().folder / "tube.draped.obj");
  EXPECT_EQ(as_floats(first.positions), run().points(0));
  EXPECT_EQ(as_floats(last.positions), run().points(100));
  EXPECT_EQ(first.triangles, last.triangles);
  EXPECT_NE(first.positions, last.positions);
}

TEST_F(GarmentExports, TextureIsThePatternInCentimetres) {
  const TriangleMesh mesh = read_mesh(run().folder / "tube.obj");
  double area = 0;
  Vec2f max{};
  for (const auto& [a, b, c] : mesh.corner_uv) {
    area += 0.5 * std::abs((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y));
    for (const Vec2f p : {a, b, c}) max = {std::max(max.x, p.x), std::max(max.y, p.y)};
  }
  EXPECT_NEAR(area, 2 * width * height, 1e-3);
  EXPECT_FLOAT_EQ(max.x, width);
  EXPECT_FLOAT_EQ(max.y, height);
  // At the start panels are as they lie in the pattern, but for what spans the open seams.
  int same = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3d edge = mesh.positions[mesh.triangles[t][1]] - mesh.positions[mesh.triangles[t][0]];
    const Vec2f flat = mesh.corner_uv[t][1] - mesh.corner_uv[t][0];
    same += std::abs(100 * length(edge) - std::hypot(flat.x, flat.y)) < 1e-4 ? 1 : 0;
  }
  EXPECT_GT(same, static_cast<int>(mesh.triangles.size()) / 2);
}

/// The lines of a text that begin with a word and a blank.
std::vector<std::string> lines_of(const std::string& text, const std::string& word) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(word + " ")) lines.push_back(line);
  return lines;
}

TEST_F(GarmentExports, ObjNamesPanelsAndDrawsSeams) {
  const std::string text = read_file(run().folder / "tube.obj");
  EXPECT_EQ(lines_of(text, "g"),
            (std::vector<std::string>{"g back", "g front", "g seam_front.1-back.2",
                                      "g seam_front.3-back.0"}));
  const std::vector<std::string> seams = lines_of(text, "l");
  ASSERT_EQ(seams.size(), 2);
  std::istringstream words(seams[0].substr(1));
  std::vector<int> line;
  for (int v = 0; words >> v;) line.push_back(v - 1);
  EXPECT_EQ(line.size(), along + 1);
  const TriangleMesh mesh = read_mesh(run().folder / "tube.draped.obj");
  const auto uses = uses_of_edges(mesh.triangles);
  for (std::size_t k = 1; k < line.size(); ++k)
    EXPECT_EQ(uses.at(std::minmax(line[k - 1], line[k])), 2);
}

TEST(GarmentGroups, StayApartWhereTheirNamesDifferInBlanksAlone) {
  const test::TemporaryFolder folder;
  std::string pattern = test::tube_pattern(width, height, 24, 100);
  for (const auto& [from, to] : {std::pair{"\"back\"", "\"a b\""}, {"\"front\"", "\"a_b\""}})
    for (std::size_t at = 0; (at = pattern.find(from, at)) != pattern.npos;)
      pattern.replace(at, std::string_view(from).size(), to);
  Scene scene = tube(folder / "tube.json", 1);
  write_file(folder / "tube.json", [&](std::ostream& out) { out << pattern; });
  const ExportedRun run(scene);
  const std::vector<std::string> groups = lines_of(read_file(run.folder / "tube.obj"), "g");
  ASSERT_EQ(groups.size(), 4U);
  EXPECT_EQ(groups[0], "g a_b");
  EXPECT_EQ(groups[1], "g a_b_2");
  EXPECT_EQ(std::set<std::string>(groups.begin(), groups.end()).size(), 4U);
}

TEST_F(GarmentExports, CacheOfTheImageKeepsPanelsApart) {
  const PointCache image = read_point_cache(run().folder / "tube.image.pc2");
  EXPECT_EQ(image.points - run().cache.points, 2 * (along + 1));
}

TEST_F(GarmentExports, PanelsAreImagesOfTheirOwn) {
  Imf::MultiPartInputFile file((run().folder / "tube.panels.exr").c_str());
  ASSERT_EQ(file.parts(), 2);
  EXPECT_EQ(file.header(1).name(), "front");
  for (const char* channel : {"R", "G", "B", "U", "V"})
    EXPECT_NE(file.header(0).channels().findChannel(channel), nullptr) << channel;
  const Imath::Box2i window = file.header(0).dataWindow();
  EXPECT_EQ((window.max.x + 1) * (window.max.y + 1), (across + 1) * (along + 1));
}

TEST(SewnPoints, LeaveOutWhatADartFoldsAtItsTip) {
  // A square with a dart in its lower edge.
  const Pattern pattern = parse_pattern(
      R"({"pattern":{"panels":{"p":{"vertices":[[0,0],[18,0],[20,15],[22,0],[40,0],[40,40],[0,40]],
          "edges":[{"endpoints":[0,1]},{"endpoints":[1,2]},{"endpoints":[2,3]},{"endpoints":[3,4]},
                   {"endpoints":[4,5]},{"endpoints":[5,6]},{"endpoints":[6,0]}],
          "translation":[0,0,0],"rotation":[0,0,0]}},
          "stitches":[[{"panel":"p","edge":1},{"panel":"p","edge":2}]]},
          "properties":{"units_in_meter":100}})",
      "dart");
  const Garment garment = make_garment(pattern, "dart", 0.03);
  const SurfacePoints points = sewn_points(garment.image, garment.sewn);
  std::vector<Triangle> triangles;
  for (Triangle t : points.triangles) {
    for (int& corner : t) corner = points.vertex_of[corner];
    triangles.push_back(t);
  }
  const auto uses = uses_of_edges(triangles);
  for (const auto& [edge, count] : uses) EXPECT_LE(count, 2);
  // A disk.
  EXPECT_EQ(static_cast<int>(points.sample_of.size()) - static_cast<int>(uses.size()) +
                static_cast<int>(triangles.size()),
            1);
}

}  // namespace
}  // namespace weft
