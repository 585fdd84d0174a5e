#include "weft/param/vertex_star.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/param/disks.h"
#include "weft/cloth/cloth.h"

namespace weft::vertex_star_test {
namespace {

constexpr double inverse = 0.4;

/// An inner vertex of a hilly sheet, mapped with some noise.
struct Case {
  DiskMesh disk = test::sheet(4, [](double x, double y) { return x * y + 0.3 * x * x; });
  CollapseHierarchy mesh{disk};
  std::vector<StarTriangle> triangles;
  std::vector<Vec2d> uv;
  VertexStar star;

  Case(int vertex, double quartic) {
    Random random(5);
    for (const SurfaceTriangle& surface : surface_triangles(disk.positions, disk.triangles))
      triangles.push_back({surface, quartic, inverse});
    for (const Vec3d& p : disk.positions)
      uv.push_back({p.x + random.uniform(-0.05, 0.05), p.y + random.uniform(-0.05, 0.05)});
    star.gather(mesh, triangles, uv, vertex);
  }
};

constexpr int inner = 12;
constexpr int on_border = 2;

TEST(VertexStar, EnergyIsThatOfTheTrianglesAroundTheVertex) {
  constexpr double quartic = 0.7;
  for (const int vertex : {inner, on_border}) {
    const Case c(vertex, quartic);
    double expected = 0;
    for (std::size_t t = 0; t < c.triangles.size(); ++t) {
      const auto& [a, b, d] = c.disk.triangles[t];
      if (a != vertex && b != vertex && d != vertex) continue;
      const SurfaceTriangle& surface = c.triangles[t].surface;
      const double m = triangle_stretch(surface, c.uv[a], c.uv[b], c.uv[d]).mean_square;
      const double plane = cross(c.uv[b] - c.uv[a], c.uv[d] - c.uv[a]);
      expected += surface.area * (m + quartic / 2 * m * m) + inverse * 2 * m * plane * plane;
    }
    EXPECT_NEAR(c.star.energy(c.uv[vertex]), expected, 1e-12 * expected);
    EXPECT_NEAR(c.star.model(c.uv[vertex]).energy, expected, 1e-12 * expected);
  }
}

TEST(VertexStar, DerivativesAreThoseOfTheEnergy) {
  for (const double quartic : {0.0, 2.0}) {
    const Case c(inner, quartic);
    const Vec2d place = c.uv[inner];
    const VertexStar::Model model = c.star.model(place);
    constexpr double h = 1e-5;
    for (const Vec2d direction : {Vec2d{1, 0}, Vec2d{0, 1}, Vec2d{0.6, 0.8}}) {
      const double after = c.star.energy(place + h * direction);
      const double before = c.star.energy(place + -h * direction);
      const double here = c.star.energy(place);
      EXPECT_NEAR(dot(model.gradient, direction), (after - before) / (2 * h), 1e-5 * here);
      EXPECT_NEAR(model.hessian.along(direction), (after - 2 * here + before) / (h * h),
                  1e-2 * here);
    }
  }
}

TEST(VertexStar, SquaresAreNeverNegative) {
  const Case c(inner, 1.0);
  Random random(2);
  for (int k = 0; k < 200; ++k) {
    const Vec2d place =
        c.uv[inner] + Vec2d{random.uniform(-0.15, 0.15), random.uniform(-0.15, 0.15)};
    if (!c.star.is_valid(place)) continue;
    const Symmetric2 squares = c.star.model(place).squares;
    EXPECT_GT(squares.xx, 0);
    EXPECT_GE(squares.determinant(), -1e-9 * squares.xx * squares.yy);
  }
}

TEST(VertexStar, WayEndsWhereTheFirstTriangleCloses) {
  const Case c(inner, 0);
  for (const Vec2d step : {Vec2d{1, 0}, Vec2d{-0.3, 0.2}, Vec2d{0, -2}}) {
    const double step_length = c.star.free_step_length(c.uv[inner], step);
    ASSERT_TRUE(std::isfinite(step_length));
    EXPECT_TRUE(c.star.is_valid(c.uv[inner] + 0.999 * step_length * step));
    EXPECT_FALSE(c.star.is_valid(c.uv[inner] + 1.001 * step_length * step));
  }
}

}  // namespace
}  // namespace weft::vertex_star_test
