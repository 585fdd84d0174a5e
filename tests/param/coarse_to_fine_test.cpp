#include "weft/param/coarse_to_fine.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/param/disks.h"
#include "weft/param/chords.h"
#include "weft/param/disk_geometry.h"
#include "weft/param/interior_solver.h"
#include "weft/param/stretch_newton.h"
#include "weft/param/weights.h"

namespace weft {
namespace {

/// Two bumps; 7200 triangles.
DiskMesh hills() {
  DiskMesh disk = test::sheet(60, [](double x, double y) {
    const auto bump = [&](double cx, double cy) {
      return std::exp(-30 * ((x - cx) * (x - cx) + (y - cy) * (y - cy)));
    };
    return 0.8 * bump(0.3, 0.4) - 0.6 * bump(0.7, 0.6);
  });
  split_chords(disk);
  return disk;
}

bool map_plainly(const DiskMesh& disk, std::span<Vec2d> uv, int newton_steps) {
  const DiskGeometry geometry(disk);
  InteriorSolver solver(disk, geometry.edges);
  std::vector<double> weights = symmetric_weights(disk, geometry.edges, geometry.sides);
  if (!map_by_reweighting(geometry, solver, weights, uv, {})) return false;
  minimise_by_newton(geometry, uv, {.steps = newton_steps, .min_gain = 1e-4});
  return true;
}

TEST(CoarseToFine, MapsAsWellAsNewtonStepsOnAllVertices) {
  const DiskMesh disk = hills();
  const DiskGeometry geometry(disk);
  std::vector<Vec2d> plain = test::square_border(disk, 64);
  std::vector<Vec2d> refined = plain;
  ASSERT_TRUE(map_plainly(disk, plain, 40));
  int coarse = 0;
  const MapDisk map = [&](const DiskMesh& part, std::span<Vec2d> uv,
                          std::span<const BorderFreedom>) {
    coarse = static_cast<int>(part.triangles.size());
    return map_plainly(part, uv, 40);
  };
  ASSERT_TRUE(map_coarse_to_fine(disk, refined, map, {.triangles = 2000}));
  EXPECT_LE(coarse, 2000);
  EXPECT_TRUE(is_valid_map(disk.triangles, refined));
  EXPECT_LT(geometry.stretch_l2(refined), 1.003 * geometry.stretch_l2(plain));
  EXPECT_GT(geometry.stretch_l2(refined), 1);
}

TEST(CoarseToFine, MapsALargeDiskAsWell) {
  const DiskMesh disk = hills();
  const DiskGeometry geometry(disk);
  const MapDisk map = [](const DiskMesh& part, std::span<Vec2d> uv,
                         std::span<const BorderFreedom>) { return map_plainly(part, uv, 40); };
  std::vector<Vec2d> small = test::square_border(disk, 64);
  std::vector<Vec2d> large = small;
  ASSERT_TRUE(map_coarse_to_fine(disk, small, map, {.triangles = 1000}));
  ASSERT_TRUE(map_coarse_to_fine(disk, large, map, {.triangles = 1000, .many = 1500}));
  EXPECT_TRUE(is_valid_map(disk.triangles, large));
  EXPECT_NE(small, large) << "rounds of many triangles pass over what is at rest";
  EXPECT_LT(geometry.stretch_l2(large), 1.001 * geometry.stretch_l2(small));
}

TEST(CoarseToFine, GivesTheSameBitsForAnyNumberOfThreads) {
  const DiskMesh disk = test::shuffled(hills());
  const MapDisk map = [](const DiskMesh& part, std::span<Vec2d> uv,
                         std::span<const BorderFreedom>) { return map_plainly(part, uv, 5); };
  for (const int many : {1500, 200000}) {
    std::vector<Vec2d> alone = test::square_border(disk, 64);
    const std::vector<Vec2d> border = alone;
    ASSERT_TRUE(map_coarse_to_fine(disk, alone, map, {.triangles = 1000, .many = many}));
    for (const int threads : {2, 3, 7}) {
      std::vector<Vec2d> uv = border;
      ASSERT_TRUE(
          map_coarse_to_fine(disk, uv, map, {.triangles = 1000, .many = many, .threads = threads}));
      EXPECT_EQ(uv, alone) << threads << " threads, " << many;
    }
  }
}

TEST(CoarseToFine, GoesCoarserWhereTheCoarseMapFails) {
  const DiskMesh disk = hills();
  std::vector<Vec2d> uv = test::square_border(disk, 64);
  std::vector<int> tried;
  const MapDisk map = [&](const DiskMesh& part, std::span<Vec2d> part_uv,
                          std::span<const BorderFreedom>) {
    tried.push_back(static_cast<int>(part.triangles.size()));
    return part.triangles.size() < 1000 && map_plainly(part, part_uv, 0);
  };
  ASSERT_TRUE(map_coarse_to_fine(disk, uv, map, {.triangles = 3000, .sweeps = 2}));
  EXPECT_TRUE(is_valid_map(disk.triangles, uv));
  ASSERT_GE(tried.size(), 2U);
  EXPECT_GT(tried.front(), 1000);
  EXPECT_LT(tried.back(), 1000);
}

TEST(CoarseToFine, SaysSoWhereNoCoarseMapIsValid) {
  const DiskMesh disk = hills();
  std::vector<Vec2d> uv = test::square_border(disk, 64);
  const MapDisk never = [](const DiskMesh&, std::span<Vec2d>, std::span<const BorderFreedom>) {
    return false;
  };
  EXPECT_FALSE(map_coarse_to_fine(disk, uv, never, {}));
}

TEST(CoarseToFine, TakesTrianglesWithoutAreaAndCoincidentVertices) {
  DiskMesh disk = hills();
  std::vector<Vec2d> uv = test::square_border(disk, 64);
  for (int k = 0; k < 40; ++k) disk.positions[700 + 3 * k] = disk.positions[701 + 3 * k];
  const MapDisk map = [&](const DiskMesh& part, std::span<Vec2d> part_uv,
                          std::span<const BorderFreedom>) { return map_plainly(part, part_uv, 5); };
  ASSERT_TRUE(map_coarse_to_fine(disk, uv, map, {.triangles = 2000}));
  EXPECT_TRUE(is_valid_map(disk.triangles, uv));
}

}  // namespace
}  // namespace weft
