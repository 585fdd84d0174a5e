#include "weft/param/four_corners.h"

#include <cmath>

#include <gtest/gtest.h>

#include "weft/core/math.h"
#include "weft/param/square_map.h"

namespace weft {
namespace {

/// A grid of 8 x 24 quads, placed by where(x, y) of [0, 1]^2.
template <class Where>
CutDisk patch(const Where& where) {
  constexpr int cols = 8, rows = 24;
  TriangleMesh mesh;
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= cols; ++c)
      mesh.positions.push_back(where(static_cast<double>(c) / cols, static_cast<double>(r) / rows));
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < cols; ++c) {
      const int a = r * (cols + 1) + c, b = a + cols + 1;
      mesh.triangles.push_back({a, a + 1, b + 1});
      mesh.triangles.push_back({a, b + 1, b});
    }
  return cut_open(mesh, Cut{});
}

CutDisk rectangle(double width, double height) {
  return patch([&](double x, double y) { return Vec3d{width * x, height * y, 0}; });
}

/// Its middle line goes up and down along a sine of that amplitude.
CutDisk ribbon(double width, double length, double amplitude) {
  return patch([&](double x, double y) {
    return Vec3d{width * x, length * y, amplitude * sine(6 * y)};
  });
}

TEST(FourCorners, AreWhereTheBorderTurns) {
  const CutDisk cut = rectangle(1, 3);
  const auto corners = four_corners(cut);
  ASSERT_TRUE(corners);
  for (const int corner : *corners) {
    const Vec3d p = cut.disk.positions[cut.disk.border[corner]];
    EXPECT_TRUE((p.x == 0 || p.x == 1) && (p.y == 0 || p.y == 3)) << p.x << ' ' << p.y;
  }
}

TEST(FourCorners, OfTrapezoidsSectorsAndBentSheets) {
  const auto sector = [](double x, double y) {
    const double radius = 0.3 + y;
    return Vec3d{radius * cosine(2 * x), 0, radius * sine(2 * x)};
  };
  const auto trapezoid = [](double x, double y) { return Vec3d{(x - 0.5) * (1 - 0.8 * y), y, 0}; };
  EXPECT_TRUE(four_corners(patch(sector)));
  EXPECT_TRUE(four_corners(patch(trapezoid)));
  EXPECT_TRUE(four_corners(ribbon(1, 1, 0.2)));
}

TEST(FourCorners, OfNoOtherDisks) {
  const auto disk = [](double x, double y) {
    const Vec3d p{2 * x - 1, 2 * y - 1, 0};
    const double radius = std::max(std::abs(p.x), std::abs(p.y));
    return radius > 0 ? radius / length(p) * p : p;
  };
  const auto bevelled = [](double x, double y) {
    return Vec3d{x, y + (x > 0.9 ? 0.4 * y - 0.2 : 0), 0};
  };
  EXPECT_FALSE(four_corners(patch(disk)));
  EXPECT_FALSE(four_corners(patch(bevelled)));
  EXPECT_FALSE(four_corners(rectangle(1, 13))) << "too long";
  EXPECT_TRUE(four_corners(ribbon(1, 1.5, 0.2)));
  EXPECT_FALSE(four_corners(ribbon(1, 5, 0.5))) << "curved, and needs samples along";
}

/// How far cells of a map are from right angles, as a cosine.
double largest_skew(const MappedDisk& mapped) {
  double largest = 0;
  for (const auto& [a, b, c] : mapped.cut.disk.triangles) {
    const Vec2d p = mapped.map.uv[b] - mapped.map.uv[a], q = mapped.map.uv[c] - mapped.map.uv[a];
    const double area = p.x * q.y - p.y * q.x;
    const std::vector<Vec3d>& at = mapped.cut.disk.positions;
    const Vec3d x = at[b] - at[a], y = at[c] - at[a];
    const Vec3d du = 1 / area * (q.y * x - p.y * y), dv = 1 / area * (p.x * y - q.x * x);
    largest = std::max(largest, std::abs(dot(du, dv)) / (length(du) * length(dv)));
  }
  return largest;
}

TEST(FourCorners, RowsAndColumnsOfARectangleRunAlongItsSides) {
  for (const double height : {0.3, 1.0, 2.0, 9.0})
    EXPECT_LT(largest_skew(map_to_square(rectangle(1, height), {.size = 33})), 0.02) << height;
}

TEST(FourCorners, LongSidesGoAlongLongSidesOfTheChart) {
  for (const double height : {0.2, 5.0}) {
    const MappedDisk mapped = map_to_square(rectangle(1, height), {.size = {17, 65}});
    EXPECT_LT(mapped.quality.stretch_linf, 1.2) << height;
    EXPECT_LT(largest_skew(mapped), 0.02) << height;
  }
}

}  // namespace
}  // namespace weft
