#include "weft/collide/filter/separating_plane_filter.h"

#include <gtest/gtest.h>

#include "weft/core/random.h"

namespace weft {
namespace {

/// Points over planes that hold them up: each is alone on its side a.
struct Held {
  std::vector<FilteredPoint> points;
  std::vector<SeparatingPlane> planes;
  SeparatingPlaneFilter filter;
  ThreadTeam team{2};

  void add_point(Vec3f start, Vec3f end) { points.push_back({start, start, end}); }
  void add_plane(int point, Vec3d normal, double level) {
    SeparatingPlane plane;
    plane.normal = plane.turned = normalized(normal);
    plane.at_end.a = plane.still.a = level;
    plane.points[0] = point;
    plane.count_a = 1;
    planes.push_back(plane);
  }
  [[nodiscard]] bool satisfied() {
    return filter.all_satisfied(
        planes, static_cast<int>(points.size()), [&](int i) { return points[i]; }, team);
  }
  SeparatingPlaneFilter::Result hold(double slack, double farthest) {
    const auto result = filter.find_ends(
        planes, static_cast<int>(points.size()), {slack, farthest},
        [&](int i) { return points[i]; }, team);
    filter.put_ends([&](int i, Vec3f end) { points[i].end = end; });
    return result;
  }
};

TEST(SeparatingPlaneFilter, PutsAPointOntoItsPlane) {
  Held held;
  held.add_point({0, 0.1F, 0}, {0.3F, -0.02F, 0});
  held.add_plane(0, {0, 1, 0}, 0);
  EXPECT_FALSE(held.satisfied());
  const auto result = held.hold(0.001, 0.05);
  EXPECT_EQ(result.far, 1);
  EXPECT_EQ(result.stopped + result.lost, 0);
  EXPECT_NEAR(held.points[0].end.y, 0, 1e-5);
  EXPECT_FLOAT_EQ(held.points[0].end.x, 0.3F);  // along the plane it goes on
  EXPECT_TRUE(held.satisfied());
}

TEST(SeparatingPlaneFilter, StopsAPointOnItsWayThatIsTooFarBeyond) {
  Held held;
  held.add_point({0, 0.1F, 0}, {0.3F, -0.2F, 0});
  held.add_plane(0, {0, 1, 0}, 0);
  const auto result = held.hold(0.001, 0.05);
  EXPECT_EQ(result.stopped, 1);
  EXPECT_EQ(held.filter.stopped().size(), 1U);
  const Vec3f end = held.points[0].end;
  EXPECT_NEAR(end.x, 0.1 - end.y, 1e-6);  // still on its path
  EXPECT_GT(end.x, 0.05F);
  EXPECT_TRUE(held.satisfied());
}

TEST(SeparatingPlaneFilter, SaysWhatHasNoPlace) {
  Held held;
  held.add_point({0, 0.1F, 0}, {0, 0.1F, 0});
  held.add_plane(0, {0, 1, 0}, 0.2);  // a body has moved onto it
  held.add_plane(0, {0, -1, 0}, 0.2);
  EXPECT_EQ(held.hold(0.001, 10).lost, 1);
  EXPECT_EQ(held.filter.lost().size(), 1U);
}

TEST(SeparatingPlaneFilter, LeavesAllOnTheirSidesOfManyPlanes) {
  Random random(5);
  const auto some = [&](double most) { return most * random.uniform(-1, 1); };
  Held held;
  for (int i = 0; i < 300; ++i) {
    held.add_point({}, {static_cast<float>(some(0.1)), static_cast<float>(some(0.1)),
                        static_cast<float>(some(0.1))});
    // The start lies above all of its planes.
    for (int k = 0; k < 5; ++k)
      held.add_plane(i, Vec3d{some(1), some(1), some(1)}, -0.05 * random.uniform());
  }
  const auto result = held.hold(0.001, 0.05);
  EXPECT_GT(result.far, 50);
  EXPECT_GT(result.stopped, 5);
  EXPECT_EQ(result.lost, 0);
  EXPECT_TRUE(held.satisfied());
}

/// A plane that turns with ends is straight for points that another plane holds back.
TEST(SeparatingPlaneFilter, StraightensPlanesOfPointsThatDoNotStayAtTheirEnds) {
  const auto held_by = [](double level) {
    Held held;
    held.add_point({0, 0.1F, 0}, {0.05F, 0.1F, 0});
    held.add_plane(0, {0, 1, 0}, 0.05);
    SeparatingPlane& turning = held.planes.back();
    turning.turned = normalized(Vec3d{-0.2, 1, 0});
    turning.turns = turning.follows_ends = true;
    turning.at_end.a = 0.08;
    turning.halfway.a = 0.1;
    turning.straight.a = 0.099;
    turning.still.a = 0.05;
    held.add_plane(0, {-1, 0, 0}, level);
    held.hold(0.001, 0.05);
    return held.planes.front();
  };
  EXPECT_TRUE(held_by(-0.06).follows_ends);
  const SeparatingPlane straight = held_by(-0.02);
  EXPECT_FALSE(straight.follows_ends);
  EXPECT_EQ(straight.turned, straight.normal);
  EXPECT_EQ(straight.at_end, straight.straight);
}

/// Point 1 may stay at its end until point 0 below it is stopped. The plane that turned with that
/// end is straight then, too.
TEST(SeparatingPlaneFilter, StraightensPlanesOfPointsThatAreStoppedLater) {
  Held held;
  held.add_point({0, 0.05F, 0}, {0, -0.3F, 0});
  held.add_point({0, 0.1F, 0}, {0, -0.2F, 0});
  held.add_plane(0, {0, 1, 0}, 0.03);  // a floor, too far for point 0 to be put onto it
  SeparatingPlane between;
  between.normal = between.turned = {0, 1, 0};
  between.points = {1, 0};
  between.count_a = between.count_b = 1;
  between.at_end = {-0.25, -0.25};
  between.still = {0.075, 0.075};
  held.planes.push_back(between);
  SeparatingPlane turning;
  turning.normal = {-1, 0, 0};
  turning.turned = normalized(Vec3d{-1, 0.5, 0});
  turning.points[0] = 1;
  turning.count_a = 1;
  turning.turns = turning.follows_ends = true;
  turning.at_end.a = turning.halfway.a = -0.3;
  turning.straight.a = turning.still.a = -0.01;
  held.planes.push_back(turning);
  EXPECT_EQ(held.hold(0.001, 0.05).stopped, 2);
  EXPECT_GE(held.points[1].end.y, 0.075F);
  EXPECT_FALSE(held.planes[2].follows_ends);
  EXPECT_EQ(held.planes[2].turned, turning.normal);
}

}  // namespace
}  // namespace weft
