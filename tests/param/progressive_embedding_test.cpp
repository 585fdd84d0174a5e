#include "weft/param/progressive_embedding.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/param/disks.h"
#include "tests/param/terrible_disks.h"
#include "weft/param/chords.h"
#include "weft/param/disk_geometry.h"
#include "weft/param/interior_map.h"
#include "weft/param/interior_solver.h"
#include "weft/param/weights.h"

namespace weft::progressive_embedding_test {
namespace {

struct Case {
  const char* name;
  DiskMesh disk;
};

std::vector<Case> terrible_disks() {
  std::vector<Case> cases = {{"needles that meet in a vertex", test::sliver_fan(400, 1e6)},
                             {"long neck", test::long_neck(6, 300, 0.05)},
                             {"neck of slivers", test::long_neck(8, 60, 1e-7)},
                             {"spiral", test::spiral(600)},
                             {"shrinking rings", test::shrinking_rings(5, 200, 0.5)},
                             {"border of four, 400 rings deep", test::long_neck(4, 400, 1)}};
  for (Case& c : cases) split_chords(c.disk);
  return cases;
}

TEST(ProgressiveEmbedding, IsValidOnTerribleDisks) {
  for (const auto& [name, disk] : terrible_disks()) {
    std::vector<Vec2d> uv = test::even_border(disk, 64);
    EXPECT_TRUE(embed_progressively(disk, uv, nullptr)) << name;
    EXPECT_TRUE(is_valid_map(disk.triangles, uv)) << name;
  }
}

TEST(ProgressiveEmbedding, SavesDisksOnWhichWeightsAndTheirReweightingFail) {
  const DiskMesh disk = test::long_neck(4, 400, 1);
  const DiskGeometry geometry(disk);
  InteriorSolver solver(disk, geometry.edges);
  std::vector<Vec2d> uv = test::even_border(disk, 64);

  std::vector<double> weights = shape_preserving_weights(disk, geometry.edges, geometry.sides);
  EXPECT_FALSE(solver.solve_general(weights, uv) && is_valid_map(disk.triangles, uv));
  weights = symmetric_weights(disk, geometry.edges, geometry.sides);
  EXPECT_FALSE(map_by_reweighting(geometry, solver, weights, uv, {.cures = 6}));
  weights.assign(weights.size(), 1.0);
  EXPECT_FALSE(map_by_reweighting(geometry, solver, weights, uv, {.cures = 6}));

  for (const Parameterizer& parameterizer :
       {Parameterizer{StretchOptions{}}, Parameterizer{FloaterOptions{}}}) {
    uv = test::even_border(disk, 64);
    ASSERT_TRUE(map_interior(disk, uv, parameterizer));
    EXPECT_TRUE(is_valid_map(disk.triangles, uv));
    EXPECT_TRUE(std::isfinite(geometry.stretch_l2(uv)));
  }
}

TEST(ProgressiveEmbedding, TakesABorderWhoseVerticesAllButMeet) {
  const DiskMesh disk = test::long_neck(24, 12, 0.1);
  std::vector<Vec2d> uv = test::even_border(disk, 64);
  // All of one side within a hair of its corner.
  for (int b = 1; b < 6; ++b) uv[disk.border[b]] = {b * 0x1p-40, 0};
  EXPECT_TRUE(embed_progressively(disk, uv, nullptr));
}

TEST(ProgressiveEmbedding, LeavesTheBorderAlone) {
  const DiskMesh disk = test::long_neck(8, 20, 0.1);
  const std::vector<Vec2d> border = test::even_border(disk, 64);
  std::vector<Vec2d> uv = border;
  ASSERT_TRUE(embed_progressively(disk, uv, nullptr));
  for (const int v : disk.border) EXPECT_EQ(uv[v], border[v]);
}

TEST(ProgressiveEmbedding, OfOneTriangleNeedsNothing) {
  DiskMesh disk;
  disk.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  disk.triangles = {{0, 1, 2}};
  disk.surface_vertex = disk.border = {0, 1, 2};
  std::vector<Vec2d> uv = {{0, 0}, {1, 0}, {0, 1}};
  EXPECT_TRUE(embed_progressively(disk, uv, nullptr));
}

}  // namespace
}  // namespace weft::progressive_embedding_test
