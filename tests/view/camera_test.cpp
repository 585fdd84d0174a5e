#include "weft/camera.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/view/shapes.h"
#include "weft/core/math.h"
#include "weft/core/random.h"

namespace weft {
namespace {

/// How far the corners of a box reach to each side of the picture: 1 is its edge.
struct Reach {
  double left = -HUGE_VAL, right = -HUGE_VAL, bottom = -HUGE_VAL, top = -HUGE_VAL;
  double nearest = HUGE_VAL;
};

Reach reach_of(const Camera& camera, const Box3d& box, double aspect) {
  const Vec3d forward = normalized(camera.target - camera.eye);
  const Vec3d right = normalized(cross(forward, camera.up));
  const Vec3d up = cross(right, forward);
  const double slope = sine(camera.vertical_angle / 2) / cosine(camera.vertical_angle / 2);
  Reach reach;
  for (int i = 0; i < 8; ++i) {
    const Vec3d p =
        Vec3d{(i & 1) != 0 ? box.upper.x : box.lower.x, (i & 2) != 0 ? box.upper.y : box.lower.y,
              (i & 4) != 0 ? box.upper.z : box.lower.z} -
        camera.eye;
    const double depth = dot(p, forward);
    const double x = dot(p, right) / (depth * slope * aspect);
    const double y = dot(p, up) / (depth * slope);
    reach.left = std::max(reach.left, -x);
    reach.right = std::max(reach.right, x);
    reach.bottom = std::max(reach.bottom, -y);
    reach.top = std::max(reach.top, y);
    reach.nearest = std::min(reach.nearest, depth);
  }
  return reach;
}

TEST(Camera, FramesAnyBoxTightlyFromAnySide) {
  Random random(7);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3d lower{random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-5, 5)};
    const Vec3d extent{random.uniform(0, 3), random.uniform(0.01, 3), random.uniform(0, 3)};
    const Box3d box{lower, lower + extent};
    const double aspect = random.uniform(0.4, 2.5);
    const Camera camera = frame_box(box, random.uniform(-4, 4), random.uniform(-1.5, 1.5), aspect);
    const Reach reach = reach_of(camera, box, aspect);
    const double frame = 1 - frame_margin;
    ASSERT_GT(reach.nearest, 0);
    ASSERT_LE(std::max({reach.left, reach.right, reach.bottom, reach.top}), frame + 1e-9);
    const bool tight_across = std::min(reach.left, reach.right) > frame - 1e-9;
    const bool tight_along = std::min(reach.bottom, reach.top) > frame - 1e-9;
    ASSERT_TRUE(tight_across || tight_along) << "trial " << trial;
  }
}

TEST(Camera, FramesPointsMoreTightlyThanTheirBox) {
  const Planes3 ball = sphere_grid(65, {1, 2, 3}, 0.5F);
  Outline outline;
  outline.add(ball);
  const Camera around_box = frame_box(bounds(ball), 0.7, 0.4, 1.5);
  const Camera around_points = frame_points(outline.points(), 0.7, 0.4, 1.5);
  const auto away = [](const Camera& camera) { return length(camera.eye - Vec3d{1, 2, 3}); };
  EXPECT_LT(away(around_points), 0.85 * away(around_box));
  // The ball touches the frame where half the angle of view, less the margin, is its own.
  const double slope = (1 - frame_margin) * 0.3093362496;  // tan(0.3)
  EXPECT_NEAR(away(around_points), 0.5 * std::sqrt(1 + 1 / (slope * slope)), 0.03);
}

TEST(Camera, WhatIsFramedForATurnStaysInTheFrameAllAround) {
  Outline outline;
  outline.add(TriangleMesh{{{-2, 0, 0.1}, {2, 1, -0.1}, {0, 3, 0.3}}, {{0, 1, 2}}});
  const std::vector<Vec3d> turning = outline.points_turning();
  const Camera first = frame_points(turning, 0, 0.3, 1.2);
  for (double azimuth = 0; azimuth < 6; azimuth += 0.37) {
    const Camera camera = frame_points(turning, azimuth, 0.3, 1.2);
    EXPECT_NEAR(length(camera.eye - camera.target), length(first.eye - first.target), 0.02);
    const Box3d low{{-2, 0, 0.1}, {-2, 0, 0.1}};
    const Reach reach = reach_of(camera, low, 1.2);
    EXPECT_LT(std::max({reach.left, reach.right, reach.bottom, reach.top}), 1);
  }
}

TEST(Outline, HoldsTheFarthestPointsAndNothingThatIsNotFinite) {
  Random random(3);
  Outline outline;
  Box3d box;
  for (int i = 0; i < 1000; ++i) {
    const Vec3d p{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    outline.add(p);
    box.add(p);
  }
  outline.add(Vec3d{NAN, 9, 9});
  Box3d kept;
  for (const Vec3d p : outline.points()) kept.add(p);
  EXPECT_EQ(kept.lower, box.lower);
  EXPECT_EQ(kept.upper, box.upper);
  EXPECT_TRUE(Outline().points().empty());
}

TEST(Camera, LooksFromTheAzimuthAskedFor) {
  const Box3d box{{-1, -1, -1}, {1, 1, 1}};
  const Camera front = frame_box(box, 0, 0, 1);
  EXPECT_NEAR(front.eye.x, 0, 1e-12);
  EXPECT_GT(front.eye.z, 1);
  const Camera right = frame_box(box, pi / 2, 0, 1);
  EXPECT_GT(right.eye.x, 1);
  EXPECT_GT(frame_box(box, 0, 0.5, 1).eye.y, 0.5);
}

TEST(Camera, FramesTheUnitCubeWhenTheBoxIsEmptyOrNotFinite) {
  const Camera wanted = frame_box({{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}, 0.3, 0.4, 1.5);
  const Camera empty = frame_box({}, 0.3, 0.4, 1.5);
  const Camera broken = frame_box({{0, 0, 0}, {1, NAN, 1}}, 0.3, 0.4, 1.5);
  EXPECT_EQ(empty.eye, wanted.eye);
  EXPECT_EQ(broken.eye, wanted.eye);
}

TEST(Camera, BoundsLeaveOutSamplesThatAreNotFinite) {
  Planes3 grid(2);
  grid.set(0, 0, {1, 2, 3});
  grid.set(0, 1, {NAN, 0, 0});
  grid.set(1, 0, {0, HUGE_VALF, 0});
  grid.set(1, 1, {-1, 4, 3});
  const Box3d box = bounds(grid);
  EXPECT_EQ(box.lower, (Vec3d{-1, 2, 3}));
  EXPECT_EQ(box.upper, (Vec3d{1, 4, 3}));
}

}  // namespace
}  // namespace weft
