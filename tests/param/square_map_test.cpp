#include "weft/param/square_map.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/param/disks.h"
#include "tests/param/surfaces.h"
#include "tests/support/meshes.h"
#include "weft/cut/open_to_disk.h"
#include "weft/error.h"
#include "weft/mesh.h"
#include "weft/param/augment.h"
#include "weft/param/proxy.h"
#include "weft/param/trial_map.h"
#include "weft/repair.h"

namespace weft {
namespace {

CutDisk opened(const TriangleMesh& mesh) { return cut_open(mesh, open_to_disk(mesh)); }

TEST(SquareMap, OfATorusIsValidAndFillsTheSquare) {
  const MappedDisk mapped = map_to_square(opened(test::torus(40, 16)), {.size = 33});
  EXPECT_EQ(mapped.quality.flipped, 0);
  EXPECT_EQ(mapped.quality.degenerate, 0);
  EXPECT_LT(mapped.quality.stretch_l2, 1.6);
  EXPECT_GE(mapped.quality.stretch_linf, mapped.quality.stretch_l2);
  double area = 0;
  for (const auto& [a, b, c] : mapped.cut.disk.triangles) {
    const auto& uv = mapped.map.uv;
    area += 0.5 * cross(uv[b] - uv[a], uv[c] - uv[a]);
  }
  EXPECT_NEAR(area, 32.0 * 32.0, 1e-9);
}

TEST(SquareMap, StretchIsBelowFloaters) {
  const CutDisk disk = opened(test::torus(40, 16));
  const MappedDisk floater = map_to_square(disk, {.size = 33, .parameterizer = FloaterOptions{}});
  const MappedDisk stretch = map_to_square(disk, {.size = 33});
  EXPECT_EQ(floater.parameterizer, "floater");
  EXPECT_EQ(stretch.parameterizer, "stretch");
  EXPECT_EQ(floater.quality.flipped + floater.quality.degenerate, 0);
  EXPECT_LT(stretch.quality.stretch_l2, floater.quality.stretch_l2);
}

TEST(SquareMap, TooSmallASizeIsAnErrorThatNamesTheLeast) {
  const CutDisk disk = opened(test::torus(40, 16));
  const int min = min_size(disk);
  ASSERT_GT(min, 2);
  try {
    map_to_square(disk, {.size = min - 1});
    FAIL() << "a map was made";
  } catch (const TopologyError& error) {
    EXPECT_NE(std::string(error.what()).find(std::to_string(min)), std::string::npos)
        << error.what();
  }
  EXPECT_EQ(map_to_square(disk, {.size = min}).quality.flipped, 0);
}

TEST(SquareMap, OfOneTriangleIsValid) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  const MappedDisk mapped = map_to_square(opened(mesh), {.size = 9});
  EXPECT_EQ(mapped.quality.flipped + mapped.quality.degenerate, 0);
}

TEST(SquareMap, CoincidentVerticesOnTheBorderAndInsideDoNoHarm) {
  const DiskMesh sheet = test::flat_sheet(10);
  TriangleMesh mesh{sheet.positions, sheet.triangles};
  mesh.positions[4] = mesh.positions[5];
  mesh.positions[49] = mesh.positions[48] = mesh.positions[47];
  const MappedDisk mapped = map_to_square(opened(mesh), {.size = 17});
  EXPECT_EQ(mapped.quality.flipped + mapped.quality.degenerate, 0);
  EXPECT_TRUE(std::isfinite(mapped.quality.stretch_l2));
  EXPECT_TRUE(std::isfinite(mapped.quality.stretch_linf));
}

TEST(SquareMap, RealMeshesComeOutValid) {
  const std::string folder = std::string(WEFT_SHARED_DIR) + "/meshes/";
  for (const char* name :
       {"gpt_mannequin.off", "cgal_eight.off", "dc_tshirt1000-tri.obj", "opt_cube.obj"}) {
    if (!std::filesystem::exists(folder + name)) GTEST_SKIP() << "no " << folder << name;
    const TriangleMesh mesh = repair_mesh(read_mesh(folder + name), {}).mesh;
    const MappedDisk mapped = map_to_square(opened(mesh), {.size = 65});
    EXPECT_EQ(mapped.quality.flipped + mapped.quality.degenerate, 0) << name;
    EXPECT_LT(mapped.quality.stretch_l2, 1.5) << name;
  }
}

TEST(Augment, CutClimbsASockAndLowersItsStretch) {
  const TriangleMesh mesh = test::sock(24, 40);
  const Cut cut = open_to_disk(mesh);
  ASSERT_TRUE(cut.edges.empty());
  const AugmentedCut longer = augment_cut(mesh, cut, {.size = 65});
  EXPECT_GE(longer.rounds, 1);
  const double before = map_to_square(cut_open(mesh, cut), {.size = 65}).quality.stretch_l2;
  const double after = map_to_square(cut_open(mesh, longer.cut), {.size = 65}).quality.stretch_l2;
  EXPECT_LT(after, 0.75 * before);
}

TEST(Augment, AFlatSheetStaysWhole) {
  const DiskMesh sheet = test::flat_sheet(12);
  const TriangleMesh mesh{sheet.positions, sheet.triangles};
  EXPECT_EQ(augment_cut(mesh, Cut{}, {.size = 65}).rounds, 0);
}

TEST(SquareMap, GivesTheSameBitsForAnyNumberOfThreads) {
  const TriangleMesh mesh = test::torus(40, 16);
  const Cut cut = open_to_disk(mesh);
  const Cut longer = augment_cut(mesh, cut, {.size = 65}).cut;
  const SquareMap alone = map_to_square(cut_open(mesh, longer), {.size = 65}).map;
  for (const int threads : {2, 3, 7}) {
    EXPECT_EQ(augment_cut(mesh, cut, {.size = 65, .threads = threads}).cut.edges, longer.edges);
    EXPECT_EQ(map_to_square(cut_open(mesh, longer), {.size = 65, .threads = threads}).map.uv,
              alone.uv);
  }
}

TEST(SquareMap, StopsWhereItsUserAsksForIt) {
  struct Stop : Progress {
    void update(std::string_view, double) override { throw Interrupted(); }
  } stop;
  const CutDisk disk = opened(test::torus(40, 16));
  for (const int threads : {1, 2})
    EXPECT_THROW((void)try_rotations(disk, std::array{0, 8, 16}, {65, threads, &stop}),
                 Interrupted);
}

TEST(Augment, ProxyJudgesLargeMeshesAlike) {
  const TriangleMesh mesh = test::sock(24, 40);
  const AugmentedCut longer = augment_cut(mesh, Cut{}, {.proxy_triangles = 800, .size = 65});
  ASSERT_GE(longer.rounds, 1);
  const double before = map_to_square(cut_open(mesh, Cut{}), {.size = 65}).quality.stretch_l2;
  const double after = map_to_square(cut_open(mesh, longer.cut), {.size = 65}).quality.stretch_l2;
  EXPECT_LT(after, 0.75 * before);
}

TEST(Augment, CutClimbsAWireWhoseFarEndCollapses) {
  // In the map of its border alone, far rings are smaller than doubles.
  TriangleMesh mesh = test::sock(12, 3000);
  for (Vec3d& p : mesh.positions) {
    const double angle = 25 * pi * p.y, radius = 0.5 + 0.1 * p.x;
    p = {radius * cosine(angle), p.y + 0.1 * p.z, radius * sine(angle)};
  }
  const AugmentedCut longer = augment_cut(mesh, Cut{}, {.size = 65});
  ASSERT_GE(longer.rounds, 1);
  EXPECT_LT(map_to_square(cut_open(mesh, longer.cut), {.size = 65}).quality.stretch_l2, 15);
}

TEST(Proxy, KeepsTopologyAndOpensToADiskAlongItsCut) {
  const TriangleMesh mesh = test::torus(60, 30);
  const Cut cut = open_to_disk(mesh);
  const Proxy proxy = coarsen(mesh, cut, 500);
  const TopologyCounts counts =
      count_topology(static_cast<int>(proxy.mesh.positions.size()), proxy.mesh.triangles);
  EXPECT_EQ(counts.genus, 1);
  EXPECT_EQ(counts.boundaries, 0);
  EXPECT_EQ(counts.components, 1);
  EXPECT_LE(proxy.mesh.triangles.size(), 500U);
  for (std::size_t v = 0; v < proxy.source_vertex.size(); ++v)
    EXPECT_EQ(proxy.mesh.positions[v], mesh.positions[proxy.source_vertex[v]]);
  const CutDisk fine = cut_open(mesh, cut);
  EXPECT_EQ(cut_open(proxy.mesh, proxy.cut).paths.size(), fine.paths.size());
}

TEST(Proxy, KeepsBorderLoops) {
  const TriangleMesh mesh = test::sock(20, 30);
  const Proxy proxy = coarsen(mesh, Cut{}, 200);
  const TopologyCounts counts =
      count_topology(static_cast<int>(proxy.mesh.positions.size()), proxy.mesh.triangles);
  EXPECT_EQ(counts.boundaries, 1);
  EXPECT_EQ(counts.euler, 1);
  EXPECT_LE(proxy.mesh.triangles.size(), 200U);
}

}  // namespace
}  // namespace weft
