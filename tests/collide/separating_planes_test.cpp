#include "weft/collide/filter/separating_planes.h"

#include <gtest/gtest.h>

#include "weft/core/math.h"
#include "weft/core/random.h"

namespace weft {
namespace {

constexpr double clearance = 1e-5;

/// About an axis in the plane of both triangles, half a metre away.
Vec3d swung(Vec3d p, double angle) {
  const Vec3d arm = p - Vec3d{0.5, 0, 0};
  return Vec3d{0.5 + cosine(angle) * arm.x - sine(angle) * arm.y,
               sine(angle) * arm.x + cosine(angle) * arm.y, p.z};
}

MovingFeature riding(double height, double angle) {
  MovingFeature feature;
  feature.start = {Vec3d{0, height, 0}, Vec3d{0.1, height, 0}, Vec3d{0, height, 0.1}};
  for (std::size_t k = 0; k < 3; ++k) {
    feature.safe_position[k] = swung(feature.start[k], angle);
    // Each ends somewhere else, deep in the other.
    feature.end[k] = feature.safe_position[k] - Vec3d{0, height > 0 ? 0.01 : -0.01, 0};
  }
  return feature;
}

double along(Vec3d n, Vec3d p) { return dot(n, p); }

TEST(SeparatingPlanes, HoldTwoThatTurnTogetherApartHoweverCloseTheyAre) {
  const MovingFeature a = riding(clearance, 0.02), b = riding(0, 0.02);
  SeparatingPlane plane;
  ASSERT_EQ(separate(a, b, {1e-4, true}, plane), Separation::plane);
  ASSERT_TRUE(plane.turns);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_GE(along(plane.turned, a.safe_position[k]), plane.still.a);
    EXPECT_LE(along(plane.turned, b.safe_position[k]), plane.still.b);
    EXPECT_GE(along(plane.normal, a.safe_position[k]) + along(plane.turned, a.start[k]),
              plane.halfway.a);
    EXPECT_LE(along(plane.normal, b.safe_position[k]) + along(plane.turned, b.start[k]),
              plane.halfway.b);
  }
}

TEST(SeparatingPlanes, ThatDoNotTurnLeaveNoRoomForThat) {
  const MovingFeature a = riding(clearance, 0.02), b = riding(0, 0.02);
  SeparatingPlane plane;
  ASSERT_EQ(separate(a, b, {1e-4, false}, plane), Separation::plane);
  double min = HUGE_VAL;
  for (std::size_t k = 0; k < 3; ++k)
    min = std::min(min, along(plane.turned, a.safe_position[k]) - plane.still.a);
  EXPECT_LT(min, -10 * clearance);
}

TEST(SeparatingPlanes, WhatHeedsATurningPlaneKeepsApartAtEveryTime) {
  Random random(7);
  for (int round = 0; round < 200; ++round) {
    MovingFeature a = riding(clearance, random.uniform(0, 0.3)), b = riding(0, 0.1);
    b.safe_position = {};
    for (std::size_t k = 0; k < 3; ++k)
      b.safe_position[k] = swung(b.start[k], random.uniform(0, 0.3));
    SeparatingPlane plane;
    if (separate(a, b, {1e-4, true}, plane) != Separation::plane || !plane.turns) continue;
    // Ends that just heed it.
    const auto end_of = [&](const MovingFeature& of, std::size_t k, bool side_a) {
      Vec3d end = of.safe_position[k];
      for (int turn = 0; turn < 100; ++turn) {
        const double level = side_a ? plane.at_end.a : plane.at_end.b;
        const double half =
            (side_a ? plane.halfway.a : plane.halfway.b) - along(plane.turned, of.start[k]);
        const double sign = side_a ? 1 : -1;
        end += sign * std::max(0.0, sign * (level - along(plane.turned, end))) * plane.turned;
        end += sign * std::max(0.0, sign * (half - along(plane.normal, end))) * plane.normal;
      }
      return end;
    };
    for (double time = 0; time <= 1; time += 0.125) {
      const Vec3d normal = (1 - time) * plane.normal + time * plane.turned;
      double min_a = HUGE_VAL, max_b = -HUGE_VAL;
      for (std::size_t k = 0; k < 3; ++k) {
        min_a = std::min(min_a, along(normal, (1 - time) * a.start[k] + time * end_of(a, k, true)));
        max_b =
            std::max(max_b, along(normal, (1 - time) * b.start[k] + time * end_of(b, k, false)));
      }
      EXPECT_GT(min_a, max_b - 1e-12) << round << " at " << time;
    }
  }
}

/// Two slivers of one flat layer, beside each other, that swings in its plane.
MovingFeature in_a_layer(double from, double angle) {
  MovingFeature feature;
  feature.start = {Vec3d{from, 0, 0}, Vec3d{from + 0.001, 0, 0}, Vec3d{from, 0.01, 0}};
  feature.safe_position = feature.start;
  for (std::size_t k = 0; k < 3; ++k) feature.end[k] = swung(feature.start[k], angle);
  return feature;
}

/// The least distance along the plane of side a from side b over a step. [m]
double least_distance(const SeparatingPlane& plane, const MovingFeature& a,
                      const MovingFeature& b) {
  double least = HUGE_VAL;
  for (double time = 0; time <= 1; time += 0.0625) {
    const Vec3d normal = (1 - time) * plane.normal + time * plane.turned;
    double min_a = HUGE_VAL, max_b = -HUGE_VAL;
    for (std::size_t k = 0; k < 3; ++k) {
      min_a = std::min(min_a, along(normal, (1 - time) * a.start[k] + time * a.end[k]));
      max_b = std::max(max_b, along(normal, (1 - time) * b.start[k] + time * b.end[k]));
    }
    least = std::min(least, min_a - max_b);
  }
  return least;
}

bool heeds(const SeparatingPlane& plane, const MovingFeature& of, bool side_a) {
  const double sign = side_a ? 1 : -1, at_end = side_a ? plane.at_end.a : plane.at_end.b,
               halfway = side_a ? plane.halfway.a : plane.halfway.b;
  for (std::size_t k = 0; k < 3; ++k) {
    if (sign * (along(plane.turned, of.end[k]) - at_end) < 0) return false;
    if (plane.turns &&
        sign * (along(plane.normal, of.end[k]) + along(plane.turned, of.start[k]) - halfway) < 0)
      return false;
  }
  return true;
}

TEST(SeparatingPlanes, TurnWithPartsOfALayerThatSwingsWithoutMeetingItself) {
  const MovingFeature a = in_a_layer(0.00102, 0.3), b = in_a_layer(0, 0.3);
  SeparatingPlane plane;
  ASSERT_EQ(separate(a, b, {1e-4, false}, plane), Separation::plane);
  ASSERT_TRUE(plane.follows_ends);
  EXPECT_TRUE(heeds(plane, a, true) && heeds(plane, b, false));
  EXPECT_GT(least_distance(plane, a, b), 1e-5);
  straighten(plane);
  EXPECT_FALSE(heeds(plane, a, true) && heeds(plane, b, false));
  EXPECT_GT(along(plane.turned, a.start[0]), plane.still.a);
  EXPECT_LT(along(plane.turned, b.start[1]), plane.still.b);
}

TEST(SeparatingPlanes, DoNotTurnWithWhatMeets) {
  MovingFeature a = in_a_layer(0.00102, 0.3);
  const MovingFeature b = in_a_layer(0, 0.3);
  for (Vec3d& end : a.end) end -= Vec3d{0.0005, 0, 0};  // into it
  SeparatingPlane plane;
  ASSERT_EQ(separate(a, b, {1e-4, false}, plane), Separation::plane);
  EXPECT_FALSE(plane.turns);
}

/// Wherever a turning plane lets both be, they keep apart at every time.
TEST(SeparatingPlanes, FollowNoEndsThatMeetOnTheWay) {
  Random random(11);
  int turned = 0;
  for (int round = 0; round < 2000; ++round) {
    MovingFeature a = in_a_layer(0.0015, 0), b = in_a_layer(0, 0);
    const double angle = random.uniform(0, 0.5);
    for (MovingFeature* of : {&a, &b})
      for (std::size_t k = 0; k < 3; ++k) {
        const auto by = [&] { return random.uniform(-0.0005, 0.0005); };
        of->end[k] = swung(of->start[k], angle) + Vec3d{by(), by(), by()};
      }
    SeparatingPlane plane;
    if (separate(a, b, {1e-4, false}, plane) != Separation::plane || !plane.turns) continue;
    ++turned;
    EXPECT_TRUE(heeds(plane, a, true) && heeds(plane, b, false)) << round;
    EXPECT_GT(least_distance(plane, a, b), 0) << round;
  }
  EXPECT_GT(turned, 100);
}

}  // namespace
}  // namespace weft
