#include "weft/param/interior_map.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "tests/param/disks.h"
#include "weft/core/orientation.h"
#include "weft/param/chords.h"
#include "weft/param/disk_geometry.h"
#include "weft/param/interior_solver.h"
#include "weft/param/stretch_newton.h"
#include "weft/param/weights.h"

namespace weft {
namespace {

DiskMesh bump() {
  DiskMesh disk = test::sheet(24, [](double x, double y) {
    return 1.2 * std::exp(-20 * ((x - 0.4) * (x - 0.4) + (y - 0.6) * (y - 0.6)));
  });
  split_chords(disk);
  return disk;
}

/// Crumpled, with needles, coincident vertices and triangles without area; the border keeps x and
/// y.
DiskMesh crumpled(int seed) {
  constexpr int side = 15;
  DiskMesh disk = test::flat_sheet(side - 1);
  Random random(seed);
  for (Vec3d& p : disk.positions) p.z = random.uniform(0, 1);
  for (int k = 0; k < 12; ++k) {
    const int inner = (1 + random.index(side - 2)) * side + 1 + random.index(side - 2);
    disk.positions[inner] = disk.positions[random.index(side * side)] + Vec3d{0, 0, k % 2 * 1e-13};
  }
  split_chords(disk);
  return disk;
}

int count_bad(const DiskMesh& disk, const std::vector<Vec2d>& uv) {
  int bad = 0;
  for (const auto& [a, b, c] : disk.triangles)
    if (orientation(uv[a], uv[b], uv[c]) <= 0) ++bad;
  return bad;
}

TEST(InteriorMap, FlipsNothingOnCrumpledSheets) {
  for (int seed = 1; seed <= 6; ++seed)
    for (const Parameterizer& parameterizer :
         {Parameterizer{StretchOptions{}}, Parameterizer{FloaterOptions{}}}) {
      const DiskMesh disk = crumpled(seed);
      std::vector<Vec2d> uv = test::square_border(disk, 64);
      ASSERT_TRUE(map_interior(disk, uv, parameterizer));
      EXPECT_EQ(count_bad(disk, uv), 0);
    }
}

TEST(InteriorMap, GivesTheSameBitsTwice) {
  const DiskMesh disk = bump();
  std::vector<Vec2d> first = test::square_border(disk, 64);
  std::vector<Vec2d> second = first;
  ASSERT_TRUE(map_interior(disk, first, StretchOptions{}));
  ASSERT_TRUE(map_interior(disk, second, StretchOptions{}));
  EXPECT_EQ(std::memcmp(first.data(), second.data(), first.size() * sizeof(Vec2d)), 0);
}

TEST(InteriorMap, OfAFlatSheetHasNoStretch) {
  const DiskMesh disk = test::flat_sheet(9);
  DiskMesh split = disk;
  split_chords(split);
  std::vector<Vec2d> uv = test::square_border(split, 64);
  ASSERT_TRUE(map_interior(split, uv, StretchOptions{.iterations = 10, .newton_steps = 60}));
  EXPECT_NEAR(DiskGeometry(split).stretch_l2(uv), 1.0, 1e-4);
}

TEST(InteriorMap, LeavesTheBorderAlone) {
  const DiskMesh disk = bump();
  const std::vector<Vec2d> border = test::square_border(disk, 64);
  std::vector<Vec2d> uv = border;
  ASSERT_TRUE(map_interior(disk, uv, StretchOptions{}));
  for (const int v : disk.border) EXPECT_EQ(uv[v], border[v]);
}

/// Keeps every fraction that it is told.
struct Listener : Progress {
  std::vector<double> heard;
  void update(std::string_view /*stage*/, double fraction) override { heard.push_back(fraction); }
};

TEST(InteriorMap, TellsOfEveryIterationSoThatItCanBeStopped) {
  const DiskMesh disk = bump();
  std::vector<Vec2d> uv = test::square_border(disk, 64);
  Listener listener;
  ASSERT_TRUE(map_interior(disk, uv, StretchOptions{.iterations = 2, .newton_steps = 3},
                           {.progress = &listener}));
  EXPECT_GE(listener.heard.size(), 5U);
  EXPECT_TRUE(std::is_sorted(listener.heard.begin(), listener.heard.end()));
  EXPECT_LE(listener.heard.back(), 1.0);
}

TEST(Reweighting, LowersTheStretchOfABump) {
  const DiskMesh disk = bump();
  const DiskGeometry geometry(disk);
  InteriorSolver solver(disk, geometry.edges);
  const auto stretch_after = [&](int iterations) {
    std::vector<double> weights = symmetric_weights(disk, geometry.edges, geometry.sides);
    std::vector<Vec2d> uv = test::square_border(disk, 64);
    EXPECT_TRUE(map_by_reweighting(geometry, solver, weights, uv, {.iterations = iterations}));
    EXPECT_TRUE(is_valid_map(disk.triangles, uv));
    return geometry.stretch_l2(uv);
  };
  const double start = stretch_after(0);
  EXPECT_LT(stretch_after(2), 0.9 * start);
  EXPECT_LE(stretch_after(10), stretch_after(2));
}

TEST(StretchNewton, EveryStepLowersTheEnergyAndKeepsTheMapValid) {
  const DiskMesh disk = bump();
  const DiskGeometry geometry(disk);
  std::vector<Vec2d> uv = test::square_border(disk, 64);
  ASSERT_TRUE(map_interior(disk, uv, StretchOptions{.iterations = 3, .newton_steps = 0}));
  double before = geometry.energy(uv);
  for (int step = 0; step < 10; ++step) {
    minimise_by_newton(geometry, uv, {.steps = 1, .min_gain = 0});
    const double after = geometry.energy(uv);
    EXPECT_LT(after, before);
    EXPECT_EQ(count_bad(disk, uv), 0);
    before = after;
  }
}

TEST(StretchNewton, FindsTheIsometryOfAFlatSheetFromAFarMap) {
  const DiskMesh disk = test::flat_sheet(16);
  const DiskGeometry geometry(disk);
  std::vector<Vec2d> uv;
  for (const Vec3d& p : disk.positions) {
    const double swirl = 24 * p.x * (1 - p.x) * p.y * (1 - p.y) * p.x;
    uv.push_back(
        {64 * (p.x - 0.4 * swirl * p.x * (1 - p.x)), 64 * (p.y + 0.3 * swirl * p.y * (1 - p.y))});
  }
  ASSERT_TRUE(is_valid_map(disk.triangles, uv));
  ASSERT_GT(geometry.stretch_l2(uv), 1.02);
  minimise_by_newton(geometry, uv, {.steps = 60, .min_gain = 0});
  EXPECT_NEAR(geometry.stretch_l2(uv), 1.0, 1e-9);
  for (std::size_t v = 0; v < uv.size(); ++v)
    EXPECT_LT(length(uv[v] - 64.0 * Vec2d{disk.positions[v].x, disk.positions[v].y}), 1e-3);
}

}  // namespace
}  // namespace weft
