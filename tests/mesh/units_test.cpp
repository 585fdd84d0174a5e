#include <gtest/gtest.h>

#include "tests/support/meshes.h"
#include "weft/mesh.h"

namespace weft {
namespace {

LengthUnit unit(std::string_view name) {
  for (const LengthUnit& known : length_units)
    if (known.name == name) return known;
  return {};
}

TriangleMesh tetrahedron_of_side(double side) {
  TriangleMesh mesh = test::tetrahedron();
  for (Vec3d& p : mesh.positions) p = side * p;
  return mesh;
}

TEST(Units, LengthsBecomeMetres) {
  const auto side = [](std::string_view name) {
    return in_metres_y_up(test::tetrahedron(), {unit(name), false}).positions[1].x;
  };
  EXPECT_EQ(side("m"), 1);
  EXPECT_EQ(side("cm"), 0.01);
  EXPECT_EQ(side("mm"), 0.001);
  EXPECT_EQ(side("in"), 0.0254);
}

TEST(Units, UpAlongZIsTurnedUpAlongYWithoutMirroring) {
  const TriangleMesh mesh = in_metres_y_up(test::tetrahedron(), {length_units[0], true});
  EXPECT_EQ(mesh.positions, (std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0}}));
  EXPECT_GT(test::volume_of(mesh), 0);
}

TEST(Units, PlausibleSizesGoWithoutAWord) {
  for (const double side : {0.05, 0.3, 1.8, 10.0})
    EXPECT_FALSE(implausible_size(tetrahedron_of_side(side), unit("m"))) << side;
}

TEST(Units, VerticesThatNoTriangleHasCountForNoSize) {
  TriangleMesh mesh = tetrahedron_of_side(1);
  const Box3d box = box_of(mesh);
  mesh.positions.push_back({1e30, -100, 0});
  EXPECT_EQ(box_of(mesh).lower, box.lower);
  EXPECT_EQ(box_of(mesh).upper, box.upper);
  EXPECT_FALSE(implausible_size(mesh, length_units[0]));
  EXPECT_TRUE(box_of({}).empty());
}

TEST(Units, ImplausibleSizesNameTheLikelyUnit) {
  EXPECT_EQ(implausible_size(tetrahedron_of_side(175), unit("m")),
            "its largest side is 175 m, which is large for a garment or a body; "
            "--unit cm would make it 1.75 m");
  EXPECT_EQ(implausible_size(tetrahedron_of_side(1750), unit("m")),
            "its largest side is 1.75e+03 m, which is large for a garment or a body; "
            "--unit mm would make it 1.75 m");
  EXPECT_EQ(implausible_size(tetrahedron_of_side(0.0175), unit("cm")),
            "its largest side is 0.0175 m, which is small for a garment or a body; "
            "--unit m would make it 1.75 m");
  EXPECT_EQ(implausible_size(tetrahedron_of_side(1e6), unit("m")),
            "its largest side is 1e+06 m, which is large for a garment or a body; "
            "--unit m|cm|mm|in says what its numbers mean");
}

}  // namespace
}  // namespace weft
