#include "weft/shapes.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/meshes.h"
#include "weft/core/math.h"
#include "weft/error.h"
#include "weft/mesh/shapes/parametric.h"
#include "weft/mesh/topology.h"

namespace weft {
namespace {

using test::area_of;
using test::topology_of;
using test::volume_of;

TEST(Shapes, ListsTheirNamesInOrder) {
  std::string names;
  for (const ShapeInfo& info : built_in_shapes()) {
    names.append(info.name).append(" ");
    EXPECT_FALSE(info.description.empty());
  }
  EXPECT_EQ(names,
            "sheet disk torus cylinder sphere cone box rod double_torus knot genus20 mannequin "
            "tshirt skirt ");
}

TEST(Shapes, SheetDiskTorusAndCylinderAreImagesByNature) {
  std::string images;
  for (const ShapeInfo& info : built_in_shapes())
    if (is_image_by_nature(info.name)) images.append(info.name).append(" ");
  EXPECT_EQ(images, "sheet disk torus cylinder ");
  EXPECT_FALSE(is_image_by_nature("no such shape"));
}

TEST(Shapes, UnknownNameIsAUsageErrorThatNamesTheNearest) {
  try {
    make_shape("shere");
    FAIL() << "no error";
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(), "builtin:shere: no such shape; did you mean builtin:sphere?");
  }
}

TEST(Shapes, SheetIsTheUnitSquareAroundTheOrigin) {
  const TriangleMesh mesh = make_shape("sheet");
  EXPECT_NEAR(area_of(mesh), 1, 1e-12);
  Box3d box;
  for (const Vec3d p : mesh.positions) box.add(p);
  EXPECT_EQ(box.lower, (Vec3d{-0.5, 0, -0.5}));
  EXPECT_EQ(box.upper, (Vec3d{0.5, 0, 0.5}));
  EXPECT_EQ(topology_of(mesh).boundaries, 1);
  EXPECT_EQ(topology_of(mesh).euler, 1);
}

TEST(Shapes, DiskHasTheAreaAndRimOfItsCircle) {
  const TriangleMesh mesh = make_shape("disk");
  EXPECT_NEAR(area_of(mesh), pi / 4, 1e-3);
  EXPECT_EQ(topology_of(mesh).euler, 1);
  const auto loops = border_loops(
      mesh.triangles, half_edges(static_cast<int>(mesh.positions.size()), mesh.triangles));
  ASSERT_EQ(loops.size(), 1U);
  for (const int v : loops[0]) EXPECT_NEAR(length(mesh.positions[v]), 0.5, 1e-15);
}

TEST(Shapes, DiskMapKeepsAreasEverywhere) {
  // Every cell of the square holds the same share of the disk, the corner cells too (up to the
  // chords that stand for arcs).
  const int n = 32;
  for (const int r : {0, 7, 20, 31})
    for (const int c : {0, 3, 26, 31}) {
      const auto at = [&](int row, int col) {
        return disk_point(static_cast<double>(col) / n, static_cast<double>(row) / n);
      };
      const Vec3d diagonal = at(r + 1, c + 1) - at(r, c), other = at(r + 1, c) - at(r, c + 1);
      const double quad = 0.5 * length(cross(diagonal, other));
      EXPECT_NEAR(quad * n * n, pi / 4, 0.03 * pi / 4) << r << ' ' << c;
    }
}

TEST(Shapes, SphereIsClosedRoundAndOutward) {
  const TriangleMesh mesh = make_shape("sphere");
  EXPECT_GE(mesh.triangles.size(), 5000U);
  const TopologyCounts counts = topology_of(mesh);
  EXPECT_EQ(counts.euler, 2);
  EXPECT_EQ(counts.boundaries, 0);
  EXPECT_EQ(counts.components, 1);
  for (const Vec3d p : mesh.positions) EXPECT_NEAR(length(p), 0.5, 1e-15);
  EXPECT_NEAR(volume_of(mesh), pi / 6, 3e-3 * pi / 6);
}

TEST(Shapes, TorusIsClosedOfGenusOneAndOutward) {
  const TriangleMesh mesh = make_shape("torus");
  const TopologyCounts counts = topology_of(mesh);
  EXPECT_EQ(counts.euler, 0);
  EXPECT_EQ(counts.genus, 1);
  EXPECT_EQ(counts.boundaries, 0);
  const double volume = 2 * pi * pi * torus_major_radius * torus_minor_radius * torus_minor_radius;
  EXPECT_NEAR(volume_of(mesh), volume, 0.01 * volume);
}

}  // namespace
}  // namespace weft
