#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/meshes.h"
#include "weft/mesh/distance.h"
#include "weft/mesh/shapes/mannequin.h"
#include "weft/mesh/topology.h"
#include "weft/mesh_statistics.h"
#include "weft/shapes.h"

namespace weft {
namespace {

using test::topology_of;
using test::volume_of;

void expect_fat_triangles(const TriangleMesh& mesh) {
  double min = 1, mean = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const double q = triangle_quality(mesh.positions[a], mesh.positions[b], mesh.positions[c]);
    min = std::min(min, q);
    mean += q / static_cast<double>(mesh.triangles.size());
  }
  EXPECT_GT(min, 0.4);
  EXPECT_GT(mean, 0.95);
}

TEST(Mannequin, IsOneClosedFigureOfGenusZeroWithFatTriangles) {
  const TriangleMesh mesh = make_shape("mannequin");
  const TopologyCounts counts = topology_of(mesh);
  EXPECT_EQ(counts.components, 1);
  EXPECT_EQ(counts.boundaries, 0);
  EXPECT_EQ(counts.euler, 2);
  EXPECT_GT(counts.triangles, 8000);
  EXPECT_LT(counts.triangles, 13000);
  expect_fat_triangles(mesh);
  for (const Vec3d p : mesh.positions) EXPECT_NEAR(mannequin_field(p), 0, 1e-6);
}

TEST(Mannequin, HasHumanSizesAndStandsOnTheGround) {
  const TriangleMesh mesh = make_shape("mannequin");
  const Box3d box = box_of(mesh);
  EXPECT_NEAR(box.lower.y, 0, 1e-6);
  EXPECT_NEAR(box.upper.y, 1.75, 0.005);
  EXPECT_NEAR(box.lower.x + box.upper.x, 0, 0.01);
  // Between a slim and a stout person; positive, so it is the outside that faces out.
  EXPECT_GT(volume_of(mesh), 0.050);
  EXPECT_LT(volume_of(mesh), 0.085);
  // The nose is what reaches furthest forward of the head: it faces +z.
  Vec3d tip;
  for (const Vec3d p : mesh.positions)
    if (p.y > 1.50 && p.z > tip.z) tip = p;
  EXPECT_NEAR(tip.x, 0, 0.01);
  EXPECT_NEAR(tip.y, 1.605, 0.02);
}

TEST(Mannequin, KeepsLegsApartAndArmsOffTheTrunk) {
  for (double y = 0.05; y < 0.76; y += 0.05)
    for (double z = -0.2; z < 0.3; z += 0.05) EXPECT_GT(mannequin_field({0, y, z}), 0.005) << y;
  for (const double y : {1.20, 1.10, 1.00, 0.90}) {
    // From the trunk outwards there is air before the arm or hand comes.
    double widest = 0;
    for (double x = 0; x < 0.7; x += 0.005)
      widest = std::max(widest, x < 0.5 ? mannequin_field({x, y, 0}) : 0);
    EXPECT_GT(widest, 0.03) << y;
  }
}

TEST(Mannequin, IsTheSameLeftAndRight) {
  for (const Vec3d p : {Vec3d{0.1, 1.6, 0.05}, {0.4, 1.2, 0.0}, {0.6, 0.9, 0.1}, {0.15, 0.02, 0.1}})
    EXPECT_EQ(mannequin_field(p), mannequin_field({-p.x, p.y, p.z}));
}

TEST(Tshirt, IsOneSurfaceWithFourSmoothOpenings) {
  const TriangleMesh mesh = make_shape("tshirt");
  const TopologyCounts counts = topology_of(mesh);
  EXPECT_EQ(counts.components, 1);
  EXPECT_EQ(counts.boundaries, 4);
  EXPECT_EQ(counts.genus, 0);
  EXPECT_GT(counts.triangles, 5000);
  EXPECT_LT(counts.triangles, 8000);
  expect_fat_triangles(mesh);
  const auto loops = border_loops(
      mesh.triangles, half_edges(static_cast<int>(mesh.positions.size()), mesh.triangles));
  for (const auto& loop : loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      // No corner along the way: successive edges turn by less than 60 degrees.
      const auto at = [&](std::size_t k) { return mesh.positions[loop[k % loop.size()]]; };
      const Vec3d before = normalized(at(i + 1) - at(i)), after = normalized(at(i + 2) - at(i + 1));
      EXPECT_GT(dot(before, after), 0.5);
    }
}

TEST(Tshirt, SitsAroundTheMannequinWithoutTouchingIt) {
  const TriangleMesh shirt = make_shape("tshirt"), body = make_shape("mannequin");
  const ClosestPointQuery query(body);
  for (const Vec3d p : sample_surface(shirt, 20000, 1)) {
    const double gap = std::sqrt(query.closest(p).squared_distance);
    EXPECT_GT(mannequin_field(p), 0);
    EXPECT_GT(gap, 0.005);
    EXPECT_LT(gap, 0.05);
  }
  // Its outside faces away from the body.
  for (const auto& [a, b, c] : shirt.triangles) {
    const Vec3d pa = shirt.positions[a], pb = shirt.positions[b], pc = shirt.positions[c];
    const Vec3d normal = normalized(cross(pb - pa, pc - pa));
    const double step = 0.003;
    EXPECT_GT(mannequin_field(pa + step * normal), mannequin_field(pa));
  }
}

TEST(Tshirt, ComesOutWithTheSameBitsEveryTime) {
  const TriangleMesh first = make_shape("tshirt"), second = make_shape("tshirt");
  EXPECT_EQ(first.positions, second.positions);
  EXPECT_EQ(first.triangles, second.triangles);
}

}  // namespace
}  // namespace weft
