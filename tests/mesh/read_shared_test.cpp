#include <filesystem>

#include <gtest/gtest.h>

#include "tests/support/errors.h"
#include "weft/mesh.h"
#include "weft/repair.h"

namespace weft {
namespace {

struct Row {
  const char* file;
  int vertices, triangles;  ///< as the file holds them
  int boundaries, genus;
};

const std::filesystem::path folder = std::filesystem::path(WEFT_SHARED_DIR) / "meshes";

class ReadShared : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no meshes in " << folder;
  }
  static RepairedMesh repaired(const char* file, ComponentChoice choice = {}) {
    return repair_mesh(read_mesh(folder / file), {file, choice});
  }
};

TEST_F(ReadShared, TopologyIsWhatIsKnownOfEachMesh) {
  const Row rows[] = {
      {"ode_spot.obj", 11533, 23062, 0, 0},
      {"ode_human_woman.obj", 6890, 13776, 0, 0},
      {"ode_torus.obj", 2304, 4608, 0, 1},
      {"c3d_rocker-arm.obj", 10044, 20088, 0, 1},
      {"bff_kitten.obj", 53123, 106246, 0, 1},
      {"cgal_eight.off", 315, 634, 0, 2},
      {"igl_fertility.off", 4494, 9000, 0, 4},
      {"cgal_turbine.off", 9210, 18460, 0, 11},
      {"ode_boot.obj", 19931, 39906, 0, 12},
      {"c3d_stanford-bunny.obj", 35947, 69451, 5, 0},
      {"igl_camelhead.off", 11381, 22704, 1, 0},
      {"gpt_mannequin.off", 428, 839, 1, 0},
      {"ode_plane_holes.obj", 8519, 16747, 27, 0},
      {"opt_torus_with_holes.obj", 959, 1838, 2, 1},
      {"dc_tshirt1000-tri.obj", 1426, 2745, 4, 0},
      {"dc_sock1055-2081.obj", 1055, 2081, 1, 0},
      {"cipc_skirt8K.obj", 8121, 15858, 2, 0},
      {"bff_inverted_triangles.obj", 12577, 24685, 6, 0},
      {"opt_48.obj", 24510, 48855, 1, 0},
      {"thingi_472042.stl", 1814, 3632, 0, 2},
      {"opt_cube.obj", 8, 12, 0, 0},
      {"opt_triangle_clockwise.obj", 3, 1, 1, 0},
  };
  for (const Row& row : rows) {
    const TriangleMesh mesh = read_mesh(folder / row.file);
    EXPECT_EQ(mesh.positions.size(), static_cast<std::size_t>(row.vertices)) << row.file;
    EXPECT_EQ(mesh.triangles.size(), static_cast<std::size_t>(row.triangles)) << row.file;
    const TopologyCounts counts = repair_mesh(mesh, {row.file, {}}).counts;
    EXPECT_EQ(counts.triangles, row.triangles) << row.file;
    EXPECT_EQ(counts.components, 1) << row.file;
    EXPECT_EQ(counts.boundaries, row.boundaries) << row.file;
    EXPECT_EQ(counts.genus, row.genus) << row.file;
  }
}

TEST_F(ReadShared, InvertedTrianglesAreOriented) {
  EXPECT_EQ(repaired("bff_inverted_triangles.obj").repairs,
            std::vector<std::string>{"oriented 10408 triangles"});
}

TEST_F(ReadShared, BeetleIsRefusedForItsNonManifoldEdges) {
  const std::string message = test::message_of<TopologyError>([] { repaired("c3d_beetle.obj"); });
  EXPECT_NE(message.find("c3d_beetle.obj: 47 non-manifold edges"), std::string::npos) << message;
}

TEST_F(ReadShared, ComponentsOfOneFileAddUpToItsGenus) {
  const std::string message =
      test::message_of<TopologyError>([] { repaired("opt_multiComp.obj"); });
  EXPECT_NE(message.find("6 components"), std::string::npos) << message;
  int genus = 0, boundaries = 0, triangles = 0;
  for (int i = 0; i < 6; ++i) {
    const RepairedMesh part = repaired("opt_multiComp.obj", {ComponentChoice::Kind::index, i});
    genus += part.counts.genus;
    boundaries += part.counts.boundaries;
    triangles += part.counts.triangles;
  }
  EXPECT_EQ(genus, 3);
  EXPECT_EQ(boundaries, 6);
  EXPECT_EQ(triangles, 7942);
}

TEST_F(ReadShared, DressIsTwoComponentsThatTouchAtVertices) {
  const ComponentChoice largest{ComponentChoice::Kind::largest, 0};
  const RepairedMesh dress = repaired("dc_dress-v17k-f34k.obj", largest);
  EXPECT_EQ(dress.components_found, 2);
  EXPECT_EQ(dress.counts.components, 1);
  EXPECT_EQ(dress.counts.boundaries, 5);
}

}  // namespace
}  // namespace weft
