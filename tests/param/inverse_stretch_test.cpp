#include <cmath>

#include <gtest/gtest.h>

#include "tests/param/disks.h"
#include "weft/param/disk_geometry.h"
#include "weft/param/stretch_newton.h"
#include "weft/param/triangle_energy.h"

namespace weft {
namespace {

TEST(InverseStretch, CountsOnlyTheShapeAndTheArea) {
  const SurfaceTriangle small{1, 0.5, 1, std::sqrt(3.0) / 4};
  const SurfaceTriangle large{4, 2, 4, std::sqrt(3.0)};
  EXPECT_GT(inverse_weight(small), 0);
  EXPECT_NEAR(inverse_weight(small), 4 * inverse_weight(large), 1e-14);
}

TEST(InverseStretch, IsBoundedForSlivers) {
  EXPECT_EQ(inverse_weight({0, 0, 0, 0}), 0);
  const double flat = inverse_weight({1, 0.5, 0.25, 0});
  EXPECT_TRUE(std::isfinite(flat));
  EXPECT_NEAR(inverse_weight({1, 0.5, 0.25, 1e-9}), flat, 1e-6 * flat);
}

TEST(InverseStretch, KeepsAShearedSheetFromCreasing) {
  // A flat strip whose map is sheared by its border so far that stretch alone would be lower with
  // its triangles sheared to and fro.
  const DiskMesh disk = test::flat_sheet(16);
  const DiskGeometry geometry(disk);
  std::vector<Vec2d> even;
  for (const Vec3d& p : disk.positions) even.push_back({16 * (p.x + 3 * p.y), 16 * p.y});
  Random random(2);
  std::vector<Vec2d> uv = even;
  std::vector<bool> border(uv.size(), false);
  for (const int v : disk.border) border[v] = true;
  for (std::size_t v = 0; v < uv.size(); ++v)
    if (!border[v]) uv[v] = uv[v] + Vec2d{random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05)};
  ASSERT_TRUE(is_valid_map(disk.triangles, uv));
  minimise_by_newton(geometry, uv, {.steps = 60, .min_gain = 1e-9});
  double farthest = 0;
  for (std::size_t v = 0; v < uv.size(); ++v)
    farthest = std::max(farthest, length(uv[v] - even[v]));
  EXPECT_LT(farthest, 0.05);
}

}  // namespace
}  // namespace weft
