#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/meshes.h"
#include "weft/core/math.h"
#include "weft/mesh/shapes/parametric.h"
#include "weft/mesh/shapes/rings.h"
#include "weft/mesh/shapes/solids.h"
#include "weft/mesh_statistics.h"
#include "weft/repair.h"
#include "weft/shapes.h"

namespace weft {
namespace {

using test::area_of;
using test::topology_of;
using test::volume_of;

struct Expected {
  std::string name;
  int genus, boundaries;
  double min_quality;
  Vec3d size;  ///< of its box [m]
};
void PrintTo(const Expected& expected, std::ostream* out) { *out << expected.name; }

class SoundShape : public testing::TestWithParam<Expected> {};

TEST_P(SoundShape, HasItsTopologyAndFacesOutwardWithoutRepair) {
  const TriangleMesh mesh = make_shape(GetParam().name);
  const RepairedMesh checked = repair_mesh(mesh, {GetParam().name, {}});
  EXPECT_TRUE(checked.repairs.empty());
  EXPECT_EQ(checked.counts.components, 1);
  EXPECT_EQ(checked.counts.genus, GetParam().genus);
  EXPECT_EQ(checked.counts.boundaries, GetParam().boundaries);
  EXPECT_GT(volume_of(mesh), 0);
}

TEST_P(SoundShape, HasFatTrianglesAndItsSize) {
  const TriangleMesh mesh = make_shape(GetParam().name);
  const MeshStatistics statistics = examine_mesh(mesh);
  EXPECT_GT(statistics.min_quality, GetParam().min_quality);
  EXPECT_GT(statistics.triangles, 3000);
  EXPECT_LT(statistics.triangles, 12000);
  Box3d box;
  for (const Vec3d p : mesh.positions) box.add(p);
  const Vec3d off = box.extent() - GetParam().size;
  EXPECT_LT(std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}), 0.005)
      << box.extent().x << ' ' << box.extent().y << ' ' << box.extent().z;
}

INSTANTIATE_TEST_SUITE_P(Shapes, SoundShape,
                         testing::Values(Expected{"cylinder", 0, 2, 0.86, {0.4, 1, 0.4}},
                                         Expected{"cone", 0, 0, 0.65, {0.5, 0.6, 0.5}},
                                         Expected{"box", 0, 0, 0.86, {0.6, 0.4, 0.5}},
                                         Expected{"rod", 0, 0, 0.8, {1, 0.04, 0.04}},
                                         Expected{"double_torus", 2, 0, 0.7, {0.94, 0.166, 0.51}},
                                         Expected{"knot", 1, 0, 0.55, {0.735, 0.34, 0.77}},
                                         Expected{"genus20", 20, 0, 0.7, {0.86, 0.06, 0.7}},
                                         Expected{"skirt", 0, 2, 0.6, {0.62, 0.56, 0.517}}),
                         [](const auto& instance) { return instance.param.name; });

TEST(Cylinder, HasTheAreaOfItsSide) {
  EXPECT_NEAR(area_of(make_shape("cylinder")), 2 * pi * cylinder_radius * cylinder_height, 2e-3);
}

TEST(Cone, HasItsVolumeAndOneTip) {
  const TriangleMesh mesh = make_shape("cone");
  const double volume = pi * cone_radius * cone_radius * cone_height / 3;
  EXPECT_NEAR(volume_of(mesh), volume, 0.005 * volume);
  EXPECT_EQ(
      std::count(mesh.positions.begin(), mesh.positions.end(), (Vec3d{0, 0.5 * cone_height, 0})),
      1);
}

TEST(Box, HasItsVolumeAndSharpEdges) {
  const TriangleMesh mesh = make_shape("box");
  EXPECT_NEAR(volume_of(mesh), box_size.x * box_size.y * box_size.z, 1e-12);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3d normal = normalized(
        cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]));
    EXPECT_NEAR(std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)}), 1, 1e-12);
  }
}

TEST(Rod, HasItsVolumeAndLiesAlongX) {
  const double volume = pi * rod_radius * rod_radius * rod_length;
  EXPECT_NEAR(volume_of(make_shape("rod")), volume, 0.03 * volume);
}

TEST(DoubleTorus, LiesOnItsField) {
  for (const Vec3d p : make_shape("double_torus").positions)
    EXPECT_NEAR(double_torus_field(p), 0, 1e-6);
}

TEST(Genus20, LiesOnItsFieldAndHasFlatSidesAndHoles) {
  for (const Vec3d p : make_shape("genus20").positions) EXPECT_NEAR(genus20_field(p), 0, 1e-6);
  EXPECT_LT(genus20_field({0.08, 0, 0}), 0);  // between two holes
  EXPECT_GT(genus20_field({0, 0, 0.08}), 0.04);
}

TEST(Knot, IsATubeOfOneRadiusThatKeepsClearOfItself) {
  constexpr int steps = 600;
  std::vector<Vec3d> line;
  for (int i = 0; i < steps; ++i) line.push_back(knot_point(static_cast<double>(i) / steps));
  for (const Vec3d p : make_shape("knot").positions) {
    double min = HUGE_VAL;
    for (const Vec3d q : line) min = std::min(min, length(p - q));
    EXPECT_NEAR(min, knot_tube_radius, 5e-4);
  }
  // Strands that pass each other leave room between their tubes.
  for (int i = 0; i < steps; ++i)
    for (int j = i + steps / 8; j < i + steps - steps / 8; ++j)
      EXPECT_GT(length(line[i] - line[j % steps]), 2 * knot_tube_radius + 0.01);
}

}  // namespace
}  // namespace weft
