#include "weft/param/chart_shape.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/cut/cut_cases.h"
#include "weft/param/rotation.h"
#include "weft/param/square_map.h"
#include "weft/shapes.h"

namespace weft {
namespace {

/// A flat rectangle of rows x cols quads, its first vertex in the middle of a long side.
TriangleMesh plank(int rows, int cols, double length, double width) {
  TriangleMesh mesh;
  const int across = cols + 1, half = cols / 2;
  const auto vertex = [&](int r, int c) { return r * across + (c + half) % across; };
  mesh.positions.resize(static_cast<std::size_t>((rows + 1) * across));
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= cols; ++c)
      mesh.positions[vertex(r, c)] = {length * c / cols, width * r / rows, 0};
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < cols; ++c) {
      mesh.triangles.push_back({vertex(r, c), vertex(r, c + 1), vertex(r + 1, c + 1)});
      mesh.triangles.push_back({vertex(r, c), vertex(r + 1, c + 1), vertex(r + 1, c)});
    }
  return mesh;
}

TEST(ChartSize, HasAboutTheCellsThatItIsAskedForInItsAspect) {
  const ChartSize size = chart_size(96 * 96, 9, 513);
  EXPECT_EQ(size, ChartSize(33, 289));
  EXPECT_EQ(chart_size(64 * 64, 4, 257), ChartSize(33, 129));
}

TEST(ChartSize, IsNoLongerThanTheImageAndThenALittleDenserAcross) {
  const ChartSize size = chart_size(200 * 200, 8, 257);
  EXPECT_EQ(size.cols, 257);
  EXPECT_EQ(size.rows, 49) << "256 / 8 would be as dense across as along";
}

TEST(ChartSize, KeepsTwoCoarserLevelsOfWhatASquareWouldHave) {
  EXPECT_EQ(chart_size(20 * 20, 100, 257).rows, 17);
  EXPECT_EQ(chart_size(12 * 12, 100, 257).rows, 9);
  EXPECT_EQ(chart_size(6 * 6, 100, 257).rows, 5);
}

TEST(FlattestFold, IsTheMiddleOfAnEndOfAStrip) {
  const TriangleMesh mesh = plank(2, 64, 32, 1);
  const CutDisk cut = cut_open(mesh, Cut{});
  const ChartSize size(9, 257);
  const std::vector<int> border = cut.disk.border;
  const BorderLayout layout = lay_out_border(cut, {size, 0});
  const std::vector<double> t = border_positions(cut, layout);
  const int fold = flattest_fold(cut, size);
  for (std::size_t b = 0; b < t.size(); ++b) {
    const Vec3d p = cut.disk.positions[border[b]];
    const double half = 0.5 * size.around();
    const double apart = std::abs(std::remainder(t[b] - fold, half));
    if (p.y == 0.5 && (p.x == 0 || p.x == 32)) {
      EXPECT_LE(apart, 2) << p.x;
    }
  }
}

TEST(MapToRectangle, AStripIsMappedAlmostWithoutStretch) {
  const TriangleMesh mesh = plank(3, 210, 70, 1);
  const MappedDisk square = map_to_square(cut_open(mesh, Cut{}), {.size = 133});
  const MappedDisk mapped = map_to_square(cut_open(mesh, Cut{}), {.size = {17, 1025}});
  EXPECT_EQ(mapped.quality.flipped + mapped.quality.degenerate, 0);
  EXPECT_GT(square.quality.stretch_l2, 3);
  EXPECT_LT(mapped.quality.stretch_l2, 1.02);
  double length = 0, height = 0;
  for (const Vec2d uv : mapped.map.uv) {
    length = std::max(length, uv.x);
    height = std::max(height, uv.y);
  }
  EXPECT_EQ(length, 1024);
  EXPECT_EQ(height, 16);
}

TEST(BestAspect, IsAStripsOwn) {
  for (const double aspect : {3.0, 10.0, 70.0}) {
    const TriangleMesh mesh = plank(4, 100, aspect, 1);
    const CutDisk disk = shape_proxy(mesh, Cut{}, {});
    const ShapeTrial square = try_aspect(disk, 1, {}), best = best_aspect(disk, {});
    EXPECT_NEAR(best.aspect, aspect, 1e-6 * aspect);
    EXPECT_LT(best.energy, 0.8 * square.energy);
  }
}

TEST(BestAspect, OfASquareAndABallThereIsNone) {
  const TriangleMesh square = plank(20, 20, 1, 1);
  EXPECT_EQ(best_aspect(shape_proxy(square, Cut{}, {}), {}).energy, HUGE_VAL);
  const TriangleMesh ball = make_shape("sphere");
  EXPECT_EQ(best_aspect(shape_proxy(ball, open_to_disk(ball), {}), {}).energy, HUGE_VAL);
}

}  // namespace
}  // namespace weft
