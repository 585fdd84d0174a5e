#include "weft/mesh/io/polygon.h"

#include <vector>

#include <gtest/gtest.h>

namespace weft {
namespace {

/// A bar with teeth as thin as needles, all of one height.
std::vector<Vec3d> comb_with(int teeth) {
  std::vector<Vec3d> corners;
  for (int i = 0; i < teeth; ++i) {
    corners.push_back({2.0 * i, 0, 0});
    corners.push_back({2.0 * i + 1, -100, 0});
  }
  corners.push_back({2.0 * teeth, 0, 0});
  corners.push_back({2.0 * teeth, 1, 0});
  corners.push_back({0, 1, 0});
  return corners;
}

double twice_area(const std::vector<Vec3d>& corners, const Triangle& t) {
  return cross(corners[t[1]] - corners[t[0]], corners[t[2]] - corners[t[0]]).z;
}

TEST(Polygon, IsCoveredOnceByTrianglesThatAllTurnAlike) {
  for (const int teeth : {1, 2, 17, 300}) {
    const std::vector<Vec3d> corners = comb_with(teeth);
    const std::vector<Triangle> triangles = split_polygon(corners);
    ASSERT_EQ(triangles.size(), corners.size() - 2);
    double sum = 0;
    for (const Triangle& t : triangles) {
      EXPECT_GT(twice_area(corners, t), 0);
      sum += twice_area(corners, t);
    }
    EXPECT_EQ(sum, 2 * (100.0 * teeth + 2 * teeth));
  }
}

}  // namespace
}  // namespace weft
