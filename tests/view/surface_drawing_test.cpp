#include <gtest/gtest.h>

#include "weft/drawing.h"
#include "weft/geometry_image.h"
#include "weft/image/builtin.h"
#include "weft/mesh/topology.h"
#include "weft/picture.h"
#include "weft/shapes.h"

namespace weft::surface_drawing_test {
namespace {

Vec3d mean_colour(const Picture& picture, int x, int y, int side) {
  Vec3d sum;
  for (int row = y; row < y + side; ++row)
    for (int col = x; col < x + side; ++col) {
      const std::size_t i = std::size_t{3} * (static_cast<std::size_t>(row) * picture.width + col);
      sum += Vec3d{static_cast<double>(picture.rgb[i]), static_cast<double>(picture.rgb[i + 1]),
                   static_cast<double>(picture.rgb[i + 2])};
    }
  return (1.0 / (side * side)) * sum;
}

TEST(Tube, RunsAtItsRadiusAroundTheCurve) {
  const std::vector<Vec3d> points{{0, 0, 0}, {1, 0, 0}, {2, 0.5, 0}, {2, 0.5, 1}};
  const TriangleMesh mesh = tube(points, 0.1);
  const TopologyCounts counts =
      count_topology(static_cast<int>(mesh.positions.size()), mesh.triangles);
  EXPECT_EQ(counts.boundaries, 2);
  EXPECT_EQ(counts.euler, 0);
  const int around = static_cast<int>(mesh.positions.size() / points.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    EXPECT_NEAR(length(mesh.positions[v] - points[v / around]), 0.1, 1e-12);
  EXPECT_TRUE(tube(std::vector<Vec3d>{{1, 1, 1}}, 0.1).triangles.empty());
}

TEST(SurfaceDrawing, ShowsTheColoursOfVerticesOnWhite) {
  const TriangleMesh mesh = make_shape("sphere");
  SurfaceDrawing drawing;
  drawing.mesh = &mesh;
  drawing.on_white = true;
  drawing.colours.assign(mesh.positions.size(), {0.9F, 0.1F, 0.1F});
  const Picture picture = draw_surface(drawing, {160, 120, 0, 0});
  const Vec3d middle = mean_colour(picture, 75, 55, 10);
  EXPECT_GT(middle.x, middle.y + 60);
  EXPECT_EQ(mean_colour(picture, 0, 0, 4), (Vec3d{255, 255, 255}));
}

TEST(SurfaceDrawing, LegendKeepsTheSizeOfThePicture) {
  const TriangleMesh mesh = make_shape("sphere");
  SurfaceDrawing drawing;
  drawing.mesh = &mesh;
  drawing.legend = stretch_legend("stretch");
  const Picture picture = draw_surface(drawing, {320, 240, 0, 0});
  EXPECT_EQ(picture.width, 320);
  EXPECT_EQ(picture.height, 240);
}

TEST(SurfaceDrawing, CurvesAreSeenInFrontAndHiddenBehind) {
  const TriangleMesh mesh = make_shape("sphere");
  SurfaceDrawing drawing;
  drawing.mesh = &mesh;
  drawing.curve_radius = 0.05;
  const Picture bare = draw_surface(drawing, {160, 120, 0, 0});
  drawing.curves = {{{{-0.2, 0, -0.5}, {0.2, 0, -0.5}}, {0, 0.8F, 0}}};
  const Vec3d apart = mean_colour(draw_surface(drawing, {160, 120, 0, 0}), 76, 56, 8) -
                      mean_colour(bare, 76, 56, 8);
  EXPECT_LT(length(apart), 1) << "of 255: no more than it keeps of the sky";
  drawing.curves = {{{{-0.2, 0, 0.5}, {0.2, 0, 0.5}}, {0, 0.8F, 0}}};
  const Vec3d seen = mean_colour(draw_surface(drawing, {160, 120, 0, 0}), 76, 56, 8);
  EXPECT_GT(seen.y, seen.x + 40);
}

TEST(SurfaceValues, FlatSheetHasStretchOneAndNoError) {
  const GeometryImage sheet = make_image_shape("sheet", 9);
  for (const double value : stretch_on_surface(sheet).values) EXPECT_NEAR(value, 1, 1e-6);
  for (const double value : error_on_surface(sheet, rebuild_mesh(sheet).mesh).values)
    EXPECT_NEAR(value, 0, 1e-12);
}

TEST(SurfaceValues, ErrorIsTheDistanceToTheMesh) {
  const GeometryImage sheet = make_image_shape("sheet", 9);
  TriangleMesh above = rebuild_mesh(sheet).mesh;
  for (Vec3d& p : above.positions) p.y += 0.25;
  for (const double value : error_on_surface(sheet, above).values) EXPECT_NEAR(value, 0.25, 1e-6);
}

}  // namespace
}  // namespace weft::surface_drawing_test
