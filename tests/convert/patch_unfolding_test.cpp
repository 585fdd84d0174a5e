#include "weft/convert/patch_unfolding.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

constexpr int side = 7;

/// A flat grid whose triangles all turn the same way, but for what a test moves.
struct Patch {
  std::vector<PatchUnfolding::Point> points;
  std::vector<Triangle> triangles;
  PlaneAt foot{{}, {0, 1, 0}};

  Patch() {
    for (int r = 0; r < side; ++r)
      for (int c = 0; c < side; ++c)
        points.push_back(
            {{0.1 * c, 0, -0.1 * r}, {0, 1, 0}, r > 0 && c > 0 && r < side - 1 && c < side - 1});
    for (int r = 0; r + 1 < side; ++r)
      for (int c = 0; c + 1 < side; ++c) {
        const int s = r * side + c;
        triangles.push_back({s, s + 1, s + side});
        triangles.push_back({s + side + 1, s + side, s + 1});
      }
  }
  [[nodiscard]] std::vector<Vec3d> displacements() const {
    const std::vector<PlaneAt> feet(triangles.size(), foot);
    return PatchUnfolding(points, triangles, feet).find({});
  }
  void unfold() {
    const std::vector<Vec3d> displacements = this->displacements();
    for (std::size_t k = 0; k < points.size(); ++k) points[k].position += displacements[k];
  }
  /// Of the triangles, along the normal, in squares of the spacing.
  [[nodiscard]] double min_area() const {
    double least = HUGE_VAL;
    for (const auto& [a, b, c] : triangles)
      least = std::min(least, cross(points[b].position - points[a].position,
                                    points[c].position - points[a].position)
                                  .y);
    return least / 0.01;
  }
};

TEST(PatchUnfolding, LeavesARegularGrid) {
  Patch patch;
  for (const Vec3d d : patch.displacements()) EXPECT_LT(length(d), 1e-7);
}

TEST(PatchUnfolding, TurnsTrianglesRound) {
  Patch patch;
  const std::vector<PatchUnfolding::Point> before = patch.points;
  patch.points[3 * side + 3].position = {0.56, 0, -0.14};
  patch.points[2 * side + 4].position = {0.15, 0, -0.5};
  ASSERT_LT(patch.min_area(), -0.5);
  patch.unfold();
  EXPECT_GT(patch.min_area(), 0.5);
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_EQ(patch.points[k].position.y, 0);
    if (!before[k].moves) {
      EXPECT_EQ(patch.points[k].position, before[k].position);
    }
  }
}

/// Points slide along planes that lean, to where the middles of triangles lie on the surface.
TEST(PatchUnfolding, MiddlesComeToTheSurface) {
  Patch patch;
  for (PatchUnfolding::Point& point : patch.points) {
    point.normal = normalized(Vec3d{1, 1, 0});
    if (point.moves) point.position.y += 0.02;
  }
  const auto farthest = [&] {
    double most = 0;
    for (const auto& [a, b, c] : patch.triangles)
      most = std::max(most, std::abs(patch.points[a].position.y + patch.points[b].position.y +
                                     patch.points[c].position.y) /
                                3);
    return most;
  };
  ASSERT_GT(farthest(), 0.0199);
  patch.unfold();
  EXPECT_LT(farthest(), 0.002);
}

TEST(PatchUnfolding, DoesWhatItCanBetweenPointsThatStay) {
  Patch patch;
  for (PatchUnfolding::Point& point : patch.points) point.moves = false;
  patch.points[3 * side + 3].position = {0.56, 0, -0.14};
  const double area = patch.min_area();
  patch.unfold();
  EXPECT_EQ(patch.min_area(), area);
}

}  // namespace
}  // namespace weft
