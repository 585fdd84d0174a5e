#include "weft/mesh/stretch.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/param/disks.h"
#include "weft/param/square_map.h"

namespace weft {
namespace {

/// The flat sheet mapped by (x, y) -> (a x + b y, c x + d y).
Stretch of_affine_map(double a, double b, double c, double d) {
  const DiskMesh disk = test::flat_sheet(5);
  std::vector<Vec2d> uv;
  for (const Vec3d& p : disk.positions) uv.push_back({a * p.x + b * p.y, c * p.x + d * p.y});
  return measure_stretch(surface_triangles(disk.positions, disk.triangles), disk.triangles, uv);
}

TEST(Stretch, OfASimilarityIsOne) {
  const Stretch stretch = of_affine_map(3, -4, 4, 3);
  EXPECT_NEAR(stretch.l2, 1.0, 1e-12);
  EXPECT_NEAR(stretch.linf, 1.0, 1e-7);
}

TEST(Stretch, OfAScalingAlongAxes) {
  const double s = 4;
  const double t = 0.5;
  const Stretch stretch = of_affine_map(s, 0, 0, t);
  EXPECT_NEAR(stretch.l2, std::sqrt((1 / (s * s) + 1 / (t * t)) / 2 * s * t), 1e-12);
  EXPECT_NEAR(stretch.linf, std::sqrt(s * t) / t, 1e-12);
}

TEST(Stretch, OfAShear) {
  // The inverse of ((1, k), (0, 1)) has (largest)^2 = (2 + k^2 + k sqrt(k^2 + 4)) / 2 and trace 2 +
  // k^2.
  const double k = 1.5;
  const Stretch stretch = of_affine_map(1, k, 0, 1);
  EXPECT_NEAR(stretch.l2, std::sqrt((2 + k * k) / 2), 1e-12);
  EXPECT_NEAR(stretch.linf, std::sqrt((2 + k * k + k * std::sqrt(k * k + 4)) / 2), 1e-12);
}

TEST(Stretch, IsInfiniteWhereATriangleIsFlipped) {
  const DiskMesh disk = test::flat_sheet(3);
  std::vector<Vec2d> uv = test::square_border(disk, 1);
  for (std::size_t v = 0; v < uv.size(); ++v) uv[v] = {disk.positions[v].x, disk.positions[v].y};
  uv[5] = {2, 2};
  const Stretch stretch =
      measure_stretch(surface_triangles(disk.positions, disk.triangles), disk.triangles, uv);
  EXPECT_TRUE(std::isinf(stretch.l2));
  EXPECT_TRUE(std::isinf(stretch.linf));
}

TEST(Stretch, LeavesOutTrianglesWithoutAreaOnTheSurface) {
  const std::vector<Vec3d> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
  const std::vector<Triangle> triangles = {{0, 1, 2}, {1, 3, 2}};
  const std::vector<Vec2d> uv = {{0, 0}, {1, 0}, {0, 1}, {1, 0}};
  const Stretch stretch = measure_stretch(surface_triangles(positions, triangles), triangles, uv);
  EXPECT_NEAR(stretch.l2, 1.0, 1e-12);
  EXPECT_NEAR(stretch.linf, 1.0, 1e-7);
}

TEST(Stretch, OfAVertexIsTheMeanAroundItRelativeToTheMap) {
  const DiskMesh disk = test::flat_sheet(4);
  std::vector<Vec2d> uv;
  for (const Vec3d& p : disk.positions) uv.push_back({2 * p.x, 0.5 * p.y});
  const double expected = std::sqrt((0.25 + 4) / 2);
  for (const double sigma :
       vertex_stretch(surface_triangles(disk.positions, disk.triangles), disk.triangles, uv))
    EXPECT_NEAR(sigma, expected, 1e-12);
}

TEST(MeasureMap, CountsFlippedAndDegenerateTrianglesExactly) {
  DiskMesh disk;
  disk.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}};
  disk.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  disk.border = {0, 1, 2, 3};
  SquareMap map{.size = 5, .uv = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {2, 2}}};
  EXPECT_EQ(measure_map(disk, map).flipped + measure_map(disk, map).degenerate, 0);
  map.uv[4] = {2, 0};
  EXPECT_EQ(measure_map(disk, map).degenerate, 1);
  // Below the border by the least number there is: rounding would call it flat.
  map.uv[4] = {2, -5e-324};
  EXPECT_EQ(measure_map(disk, map).degenerate, 0);
  EXPECT_EQ(measure_map(disk, map).flipped, 1);
}

}  // namespace
}  // namespace weft
