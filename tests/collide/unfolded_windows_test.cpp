#include "weft/collide/broad_phase/unfolded_windows.h"

#include <gtest/gtest.h>

#include "weft/collide/moving_surface.h"
#include "weft/core/math.h"
#include "weft/core/random.h"
#include "weft/mesh/crossings.h"

namespace weft {
namespace {

/// A patch of 6 x 6 samples.
struct Patch {
  static constexpr int n = 6;
  std::vector<Vec3d> points;

  [[nodiscard]] bool certain(float slack = 0) const {
    Planes3 at(n);
    for (int s = 0; s < n * n; ++s) at.set(s, vec_cast<float>(points[s]));
    const SurfaceGrid grid(n, BorderMates(), {});
    UnfoldedWindows windows(n - 1);
    ThreadTeam team(1);
    windows.find_unfolded({&grid, &at, &at}, slack / 2, team);
    // Of the first level three nodes a side are the whole.
    return windows.unfolded(Node{1, 0, 0}, Node{1, 2, 2});
  }
  [[nodiscard]] int crossings() const {
    const SurfaceGrid grid(n, BorderMates(), {});
    std::vector<Corners> triangles;
    for (int t = 0; t < 50; ++t) {
      const std::array<int, 3> s = grid.triangle(t / 2, t % 2);
      triangles.push_back({points[s[0]], points[s[1]], points[s[2]]});
    }
    int count = 0;
    for_self_crossings(triangles, {}, [&](int, int) { ++count; });
    return count;
  }
};

/// Rolled up by an angle in all, at any place and turned any way.
Patch rolled(double angle, Vec3d along, Vec3d across) {
  Patch patch;
  const Vec3d up = cross(across, along);
  for (int r = 0; r < Patch::n; ++r)
    for (int c = 0; c < Patch::n; ++c) {
      const double turned = angle * c / (Patch::n - 1), radius = 1 / angle;
      patch.points.push_back((radius * sine(turned)) * along +
                             (radius * (1 - cosine(turned))) * up + (0.2 * r) * across);
    }
  return patch;
}

TEST(Unfolded, GentleRollsAreCertainAndClosedOnesAreNot) {
  const Vec3d along = normalized(Vec3d{1, 0.3, -0.2});
  const Vec3d across = normalized(cross(along, Vec3d{0, 1, 0}));
  EXPECT_TRUE(rolled(0.1, along, across).certain());
  EXPECT_TRUE(rolled(1.0, along, across).certain());
  EXPECT_FALSE(rolled(3.2, along, across).certain());
  EXPECT_FALSE(rolled(6.5, along, across).certain());
}

TEST(Unfolded, WhatIsCertainNeverCrossesItself) {
  Random random(4);
  int certain = 0, crossing = 0;
  for (int round = 0; round < 3000; ++round) {
    Patch patch;
    const double noise = random.uniform(0, 1.2);
    for (int s = 0; s < Patch::n * Patch::n; ++s)
      patch.points.push_back(
          Vec3d{0.2 * (s % Patch::n), 0, 0.2 * (s / Patch::n)} +
          0.2 * noise * Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
    const bool crosses = patch.crossings() > 0;
    crossing += crosses ? 1 : 0;
    if (!patch.certain()) continue;
    ++certain;
    EXPECT_FALSE(crosses) << round;
  }
  EXPECT_GT(certain, 300);
  EXPECT_GT(crossing, 300);
}

TEST(Unfolded, SlackIsReckonedWith) {
  const Patch flat = rolled(0.01, {1, 0, 0}, {0, 0, 1});
  EXPECT_TRUE(flat.certain(0.02F));
  EXPECT_FALSE(flat.certain(0.2F));  // as long as an edge
}

}  // namespace
}  // namespace weft
