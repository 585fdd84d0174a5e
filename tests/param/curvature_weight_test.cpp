#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/param/disks.h"
#include "weft/param/disk_geometry.h"

namespace weft {
namespace {

std::vector<double> curvature_weight_of(const DiskMesh& disk) {
  const HalfEdges edges = half_edges(static_cast<int>(disk.positions.size()), disk.triangles);
  return curvature_weights(disk, edges, surface_triangles(disk.positions, disk.triangles));
}

TEST(CurvatureWeight, OfAFlatSheetIsTheSameEverywhere) {
  const std::vector<double> curvature_weight = curvature_weight_of(test::flat_sheet(8));
  EXPECT_GT(curvature_weight[0], 0);
  for (const double q : curvature_weight) EXPECT_EQ(q, curvature_weight[0]);
}

TEST(CurvatureWeight, IsLargestWhereTheSurfaceBends) {
  // A sheet folded along the line x = 1/2.
  const DiskMesh disk = test::sheet(20, [](double x, double) { return x > 0.5 ? x - 0.5 : 0.0; });
  const std::vector<double> curvature_weight = curvature_weight_of(disk);
  for (std::size_t t = 0; t < curvature_weight.size(); ++t) {
    double apart = 1;
    for (const int v : disk.triangles[t])
      apart = std::min(apart, std::abs(disk.positions[v].x - 0.5));
    if (apart == 0) {
      EXPECT_GT(curvature_weight[t], 2 * curvature_weight[0]);
    } else if (apart > 0.3) {
      EXPECT_EQ(curvature_weight[t], curvature_weight[0]);
    }
  }
}

TEST(CurvatureWeight, DoesNotDependOnTheUnit) {
  const auto bump = [](double x, double y) { return x * x * y; };
  const DiskMesh disk = test::sheet(10, bump);
  DiskMesh large = disk;
  for (Vec3d& p : large.positions) p = 1024.0 * p;
  const std::vector<double> a = curvature_weight_of(disk);
  const std::vector<double> b = curvature_weight_of(large);
  for (std::size_t t = 0; t < a.size(); ++t) EXPECT_NEAR(a[t], b[t], 1e-12);
}

}  // namespace
}  // namespace weft
