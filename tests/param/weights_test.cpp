#include "weft/param/weights.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/param/disks.h"
#include "weft/param/disk_geometry.h"
#include "weft/param/interior_solver.h"

namespace weft {
namespace {

/// A sheet with folds, needles, coincident vertices and triangles without area.
DiskMesh bad_sheet() {
  DiskMesh disk = test::flat_sheet(12);
  Random random(3);
  for (Vec3d& p : disk.positions) p.z = random.uniform(0, 2);
  disk.positions[40] = disk.positions[41];
  disk.positions[54] = 0.5 * (disk.positions[53] + disk.positions[55]);
  disk.positions[100] = disk.positions[87] + Vec3d{1e-14, 0, 0};
  return disk;
}

/// The smallest weight at an interior vertex; 0 if any is not finite.
double min_interior_weight(const DiskMesh& disk, const std::vector<double>& weights) {
  std::vector<bool> border(disk.positions.size(), false);
  for (const int v : disk.border) border[v] = true;
  double min = HUGE_VAL;
  for (int h = 0; h < static_cast<int>(weights.size()); ++h) {
    if (border[from_vertex(disk.triangles, h)]) continue;
    min = std::isfinite(weights[h]) ? std::min(min, weights[h]) : 0.0;
  }
  return min;
}

/// How far the map by these weights is from the flat sheet itself, [0, 1]^2.
double distance_from_identity(const DiskMesh& disk, const std::vector<double>& weights) {
  const DiskGeometry geometry(disk);
  const InteriorSolver solver(disk, geometry.edges);
  std::vector<Vec2d> uv = test::square_border(disk, 1.0);
  EXPECT_TRUE(solver.solve_general(weights, uv));
  double max = 0;
  for (std::size_t v = 0; v < uv.size(); ++v)
    max = std::max(max, length(uv[v] - Vec2d{disk.positions[v].x, disk.positions[v].y}));
  return max;
}

/// A flat sheet whose inner vertices are pushed about in the plane.
DiskMesh irregular_flat_sheet() {
  DiskMesh disk = test::flat_sheet(10);
  Random random(11);
  for (Vec3d& p : disk.positions)
    if (p.x > 0 && p.x < 1 && p.y > 0 && p.y < 1)
      p += {random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03), 0};
  return disk;
}

TEST(Weights, ArePositiveAndFiniteOnDegenerateTriangles) {
  const DiskMesh disk = bad_sheet();
  const DiskGeometry g(disk);
  EXPECT_GT(min_interior_weight(disk, mean_value_weights(disk, g.edges, g.sides)), 0.0);
  EXPECT_GT(min_interior_weight(disk, symmetric_weights(disk, g.edges, g.sides)), 0.0);
  EXPECT_GT(min_interior_weight(disk, shape_preserving_weights(disk, g.edges, g.sides)), 0.0);
}

TEST(Weights, ShapePreservingOnesSumToOne) {
  const DiskMesh disk = bad_sheet();
  const DiskGeometry g(disk);
  const std::vector<double> weights = shape_preserving_weights(disk, g.edges, g.sides);
  std::vector<double> sum(disk.positions.size(), 0.0);
  for (int h = 0; h < static_cast<int>(weights.size()); ++h)
    sum[from_vertex(disk.triangles, h)] += weights[h];
  for (const int v : disk.border) sum[v] = 1;
  for (const double s : sum) EXPECT_NEAR(s, 1.0, 1e-12);
}

TEST(Weights, ShapePreservingOnesReproduceAFlatSheet) {
  const DiskMesh disk = irregular_flat_sheet();
  const DiskGeometry g(disk);
  EXPECT_LT(distance_from_identity(disk, shape_preserving_weights(disk, g.edges, g.sides)), 1e-12);
}

TEST(Weights, MeanValueOnesReproduceAFlatSheet) {
  const DiskMesh disk = irregular_flat_sheet();
  const DiskGeometry g(disk);
  EXPECT_LT(distance_from_identity(disk, mean_value_weights(disk, g.edges, g.sides)), 1e-12);
}

TEST(Weights, SymmetricOnesAreEqualBothWays) {
  const DiskMesh disk = bad_sheet();
  const DiskGeometry g(disk);
  const std::vector<double> weights = symmetric_weights(disk, g.edges, g.sides);
  for (int h = 0; h < static_cast<int>(weights.size()); ++h) {
    const int twin = g.edges.twin[h];
    EXPECT_EQ(weights[h], weights[twin >= 0 ? twin : h]);
  }
}

TEST(Weights, CholeskyAndLuAgreeOnSymmetricOnes) {
  const DiskMesh disk = irregular_flat_sheet();
  const DiskGeometry g(disk);
  const std::vector<double> weights = symmetric_weights(disk, g.edges, g.sides);
  InteriorSolver solver(disk, g.edges);
  std::vector<Vec2d> a = test::square_border(disk, 1.0);
  std::vector<Vec2d> b = a;
  ASSERT_TRUE(solver.factorize_symmetric(weights));
  solver.solve_symmetric(a);
  ASSERT_TRUE(solver.solve_general(weights, b));
  for (std::size_t v = 0; v < a.size(); ++v) EXPECT_LT(length(a[v] - b[v]), 1e-13);
}

TEST(EdgeLengths, StayWhereTrianglesAreWellShaped) {
  const std::vector<Vec3d> positions = {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}};
  const std::vector<Triangle> triangles = {{0, 1, 2}};
  EXPECT_EQ(floored_lengths(positions, triangles)[0], (std::array<double, 3>{3, 5, 4}));
}

TEST(EdgeLengths, AreRaisedUntilEveryTriangleIsOne) {
  const std::vector<Vec3d> positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 0}};
  const std::vector<Triangle> triangles = {{0, 1, 2}, {0, 2, 3}};
  for (const auto& s : floored_lengths(positions, triangles))
    for (int k = 0; k < 3; ++k) {
      EXPECT_GT(s[k], 0.0);
      EXPECT_GT(s[k] + s[(k + 1) % 3] - s[(k + 2) % 3], 1e-6);
      EXPECT_LT(s[k], 2.001);
    }
}

TEST(EdgeLengths, HalfAngleTangentsOfTheEgyptianTriangle) {
  // Right angle at corner 0; tan(A / 2) = sin A / (1 + cos A) elsewhere.
  const auto [right, b, c] = half_angle_tangents({3, 5, 4});
  EXPECT_NEAR(right, 1.0, 1e-15);
  EXPECT_NEAR(b, 0.5, 1e-15);
  EXPECT_NEAR(c, 1.0 / 3.0, 1e-15);
}

}  // namespace
}  // namespace weft
