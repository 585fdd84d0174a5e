#include "weft/cut/open_to_disk.h"

#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

#include "tests/cut/cut_cases.h"
#include "tests/support/errors.h"
#include "tests/support/meshes.h"
#include "weft/core/math.h"
#include "weft/error.h"
#include "weft/mesh.h"
#include "weft/mesh/topology.h"
#include "weft/repair.h"

namespace weft {
namespace {

using test::cut_cases;
using test::one_triangle;
using test::slab_surface;
using test::topology_of;

void expect_disk(const DiskMesh& disk) {
  const TopologyCounts counts = topology_of({disk.positions, disk.triangles});
  EXPECT_EQ(counts.components, 1);
  EXPECT_EQ(counts.boundaries, 1);
  EXPECT_EQ(counts.euler, 1);
}

/// [V x V] lengths of shortest paths along edges, by Floyd's and Warshall's method.
std::vector<std::vector<double>> all_distances(const TriangleMesh& mesh) {
  const std::size_t n = mesh.positions.size();
  std::vector<std::vector<double>> d(n, std::vector<double>(n, 1e30));
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const int a = t[k];
      const int b = t[(k + 1) % 3];
      d[a][b] = d[b][a] = length(mesh.positions[a] - mesh.positions[b]);
    }
  for (std::size_t v = 0; v < n; ++v) d[v][v] = 0;
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) d[i][j] = std::min(d[i][j], d[i][k] + d[k][j]);
  return d;
}

TEST(OpenToDisk, EverySurfaceOpensToOneDisk) {
  for (const auto& [name, mesh] : cut_cases()) {
    SCOPED_TRACE(name);
    for (const bool straighten : {false, true})
      expect_disk(cut_open(mesh, open_to_disk(mesh, {.straighten = straighten})).disk);
  }
}

TEST(OpenToDisk, EverySeedOfADoubleTorusOpensToOneDisk) {
  const TriangleMesh mesh = slab_surface({"#####", "#.#.#", "#####"});
  for (int seed = 0; seed < static_cast<int>(mesh.triangles.size()); ++seed)
    expect_disk(cut_open(mesh, open_to_disk(mesh, {.seed_triangle = seed})).disk);
}

TEST(OpenToDisk, DiskNeedsNoCut) {
  EXPECT_TRUE(open_to_disk(slab_surface({"o"})).edges.empty());
  EXPECT_TRUE(open_to_disk(one_triangle()).edges.empty());
}

TEST(OpenToDisk, EdgesAreSortedPairsEachOnce) {
  const Cut cut = open_to_disk(slab_surface({"#####", "#.#.#", "#####"}));
  EXPECT_TRUE(std::is_sorted(cut.edges.begin(), cut.edges.end()));
  EXPECT_EQ(std::adjacent_find(cut.edges.begin(), cut.edges.end()), cut.edges.end());
  for (const auto& [a, b] : cut.edges) EXPECT_LT(a, b);
}

TEST(OpenToDisk, StraighteningNeverLengthens) {
  for (const auto& [name, mesh] : cut_cases()) {
    SCOPED_TRACE(name);
    for (int seed = 0; seed < static_cast<int>(mesh.triangles.size()); seed += 7) {
      const auto cut_length = [&, &surface = mesh](bool straighten) {
        return summarise(cut_open(surface, open_to_disk(surface, {seed, straighten}))).length;
      };
      EXPECT_LE(cut_length(true), cut_length(false) * (1 + 1e-12));
    }
  }
}

TEST(OpenToDisk, RoundTorusIsCutAlongItsShortestLoops) {
  const double major = 2;
  const double minor = 0.5;
  const TriangleMesh mesh = test::torus(60, 24, major, minor);
  const double meridian = 24 * 2 * minor * sine(pi / 24);
  const double inner_circle = 60 * 2 * (major - minor) * sine(pi / 60);
  const CutSummary summary = summarise(cut_open(mesh, open_to_disk(mesh)));
  EXPECT_LE(summary.length, (meridian + inner_circle) * (1 + 1e-9));
  EXPECT_GE(summary.length, 0.95 * (meridian + inner_circle));
}

TEST(OpenToDisk, TwoHolesAreJoinedByTheShortestBridge) {
  const TriangleMesh mesh = slab_surface({"o###o", "#####"}, 0.9);
  const auto loops = border_loops(
      mesh.triangles, half_edges(static_cast<int>(mesh.positions.size()), mesh.triangles));
  ASSERT_EQ(loops.size(), 2U);
  const auto distance = all_distances(mesh);
  double bridge = 1e30;
  for (const int a : loops[0])
    for (const int b : loops[1]) bridge = std::min(bridge, distance[a][b]);
  EXPECT_NEAR(summarise(cut_open(mesh, open_to_disk(mesh))).length, bridge, 1e-12);
}

TEST(OpenToDisk, SphereIsCutBetweenTheFarthestPair) {
  const TriangleMesh mesh = slab_surface({"######"});
  double diameter = 0;
  for (const auto& row : all_distances(mesh))
    diameter = std::max(diameter, *std::max_element(row.begin(), row.end()));
  EXPECT_NEAR(summarise(cut_open(mesh, open_to_disk(mesh))).length, diameter, 1e-12);
}

TEST(OpenToDisk, SeedTriangleThatDoesNotExistIsRefused) {
  const TriangleMesh mesh = slab_surface({"#"});
  EXPECT_EQ(test::message_of<TopologyError>([&] { open_to_disk(mesh, {.seed_triangle = 12}); }),
            "seed triangle: 12; 0 to 11, or -1 to choose");
}

TEST(ExtendCut, JoinsAVertexByAShortestPathAndKeepsADisk) {
  for (const auto& [name, mesh] : cut_cases()) {
    SCOPED_TRACE(name);
    const auto distance = all_distances(mesh);
    const Cut cut = open_to_disk(mesh);
    const CutDisk opened = cut_open(mesh, cut);
    const double before = summarise(opened).length;
    for (int v = 0; v < static_cast<int>(mesh.positions.size()); ++v) {
      double nearest = 1e30;
      for (const int b : opened.disk.border) {
        // The middle of a split edge is no vertex of the mesh.
        const auto s = static_cast<std::size_t>(opened.disk.surface_vertex[b]);
        if (s < mesh.positions.size()) nearest = std::min(nearest, distance[v][s]);
      }
      const Cut longer = extend_cut(mesh, cut, v);
      if (nearest == 0) {
        EXPECT_EQ(longer.edges, cut.edges);
        continue;
      }
      const CutDisk reopened = cut_open(mesh, longer);
      expect_disk(reopened.disk);
      EXPECT_NEAR(summarise(reopened).length, before + nearest, 1e-12);
    }
  }
}

TEST(OpenToDisk, SharedMeshesOpenToOneDisk) {
  const std::filesystem::path folder = std::filesystem::path(WEFT_SHARED_DIR) / "meshes";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is absent";
  for (const char* name : {"cgal_turbine.off", "ode_boot.obj", "ode_plane_holes.obj",
                           "igl_fertility.off", "opt_torus_with_holes.obj", "opt_cube.obj"}) {
    SCOPED_TRACE(name);
    const TriangleMesh mesh =
        repair_mesh(read_mesh(folder / name), {.name = name, .component = {}}).mesh;
    const CutDisk opened = cut_open(mesh, open_to_disk(mesh));
    expect_disk(opened.disk);
    const CutSummary summary = summarise(opened);
    EXPECT_EQ(summary.nodes - summary.paths, topology_of(mesh).euler - 1);
  }
}

}  // namespace
}  // namespace weft
