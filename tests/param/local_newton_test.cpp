#include "weft/param/local_newton.h"

#include <gtest/gtest.h>

#include "tests/param/disks.h"
#include "weft/param/disk_geometry.h"

namespace weft {
namespace {

std::vector<StarTriangle> star_triangles(const DiskGeometry& geometry) {
  std::vector<StarTriangle> triangles;
  for (const SurfaceTriangle& surface : geometry.surface) triangles.push_back({surface});
  return triangles;
}

TEST(VertexMover, SweepsFlattenAFlatSheet) {
  const DiskMesh disk = test::flat_sheet(8);
  const DiskGeometry geometry(disk);
  const CollapseHierarchy mesh(disk);
  const std::vector<StarTriangle> triangles = star_triangles(geometry);
  Random random(3);
  std::vector<Vec2d> uv = test::square_border(disk, 8);
  for (std::size_t v = 0; v < uv.size(); ++v)
    if (mesh.is_inner(static_cast<int>(v)))
      uv[v] = {8 * disk.positions[v].x + random.uniform(-0.2, 0.2),
               8 * disk.positions[v].y + random.uniform(-0.2, 0.2)};
  ASSERT_TRUE(is_valid_map(disk.triangles, uv));
  VertexMover mover(mesh, triangles, uv);
  double last = geometry.stretch_l2(uv);
  for (int k = 0; k < 60; ++k) {
    mover.sweep(1);
    EXPECT_TRUE(is_valid_map(disk.triangles, uv));
    EXPECT_LE(geometry.stretch_l2(uv), last * (1 + 1e-12));
    last = geometry.stretch_l2(uv);
  }
  EXPECT_NEAR(last, 1, 1e-6);
}

TEST(VertexMover, SweepsOverWhatIsNotAtRest) {
  const DiskMesh disk = test::flat_sheet(8);
  const DiskGeometry geometry(disk);
  const CollapseHierarchy mesh(disk);
  const std::vector<StarTriangle> triangles = star_triangles(geometry);
  std::vector<Vec2d> uv;
  for (const Vec3d& p : disk.positions) uv.push_back({8 * p.x, 8 * p.y});
  std::vector<Vec2d> moved = uv;
  moved[20] = moved[20] + Vec2d{0.3, 0.2};
  ASSERT_TRUE(is_valid_map(disk.triangles, moved));
  VertexMover mover(mesh, triangles, moved);
  mover.sweep_restless(30);
  EXPECT_TRUE(is_valid_map(disk.triangles, moved));
  for (std::size_t v = 0; v < uv.size(); ++v) EXPECT_LT(length(moved[v] - uv[v]), 0.05) << v;
}

TEST(VertexMover, CentresAVertexThatIsAllButOutside) {
  const DiskMesh disk = test::flat_sheet(2);
  const DiskGeometry geometry(disk);
  const CollapseHierarchy mesh(disk);
  const std::vector<StarTriangle> triangles = star_triangles(geometry);
  std::vector<Vec2d> uv = test::square_border(disk, 2);
  uv[4] = {1, 1e-14};
  ASSERT_TRUE(is_valid_map(disk.triangles, uv));
  VertexMover mover(mesh, triangles, uv);
  EXPECT_TRUE(mover.centre(4));
  EXPECT_GT(uv[4].y, 0.3);
  uv[4] = {1, 1};
  EXPECT_FALSE(mover.centre(4)) << "there is no better place";
  uv[4] = {1, 1e-14};
  EXPECT_GT(mover.improve(4), 0.4) << "the share of the energy that is gone";
  EXPECT_GT(uv[4].y, 0.1) << "one step is lengthened until it pays no more";
}

TEST(VertexMover, SlidesBorderVerticesAndTheirMatesToLowerStretch) {
  const DiskMesh disk = test::flat_sheet(4);
  const DiskGeometry geometry(disk);
  const CollapseHierarchy mesh(disk);
  const std::vector<StarTriangle> triangles = star_triangles(geometry);
  std::vector<Vec2d> uv;
  for (const Vec3d& p : disk.positions) uv.push_back({4 * p.x, 4 * p.y});
  // On the lower side towards the right, on the upper one, its mate, towards the left.
  BorderFreedom freedom;
  freedom.vertex = 2;
  freedom.axis = 0;
  freedom.mate = 22;
  freedom.mate_axis = 0;
  freedom.sign = -1;
  freedom.offset = 4;
  uv[2].x = 2.5;
  uv[22].x = 1.5;
  ASSERT_TRUE(is_valid_map(disk.triangles, uv));
  VertexMover mover(mesh, triangles, uv);
  const double before = geometry.stretch_l2(uv);
  for (int k = 0; k < 40; ++k) mover.sweep(1, std::span(&freedom, 1));
  EXPECT_LT(geometry.stretch_l2(uv), before);
  EXPECT_NEAR(uv[2].x, 2, 1e-3);
  EXPECT_EQ(uv[22].x, 4 - uv[2].x);
  EXPECT_EQ(uv[2].y, 0);
  EXPECT_EQ(uv[22].y, 4);
  EXPECT_TRUE(is_valid_map(disk.triangles, uv));
}

}  // namespace
}  // namespace weft
