#include "weft/mesh/shapes/remesh.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/meshes.h"
#include "weft/core/math.h"
#include "weft/core/random.h"
#include "weft/mesh/shapes/editable_mesh.h"
#include "weft/mesh/shapes/field.h"
#include "weft/mesh/shapes/patch.h"
#include "weft/mesh/shapes/solids.h"
#include "weft/mesh/topology.h"
#include "weft/mesh_statistics.h"

namespace weft {
namespace {

using test::topology_of;

double unit_ball(Vec3d p) { return length(p) - 1; }
double ring(Vec3d p) { return length(Vec3d{length(Vec3d{p.x, 0, p.z}) - 1, p.y, 0}) - 0.4; }
double wanted_length(Vec3d /*place*/) { return 0.15; }
Box3d cube(double half) { return {{-half, -half, -half}, {half, half, half}}; }

TEST(Polygonise, BallIsAClosedSphereOfItsArea) {
  const TriangleMesh mesh = polygonise(unit_ball, cube(1.2), 0.1);
  const TopologyCounts counts = topology_of(mesh);
  EXPECT_EQ(counts.euler, 2);
  EXPECT_EQ(counts.boundaries, 0);
  EXPECT_NEAR(test::volume_of(mesh), 4 * pi / 3, 0.02 * 4 * pi / 3);  // positive: outward
}

TEST(Polygonise, RandomFieldsGiveClosedManifolds) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    // Noise at the grid points: every pattern of signs comes up.
    const Field noise = [seed](Vec3d p) {
      const auto cell = [](double v) {
        return static_cast<std::uint64_t>(std::llround(10 * v) + 100);
      };
      if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > 0.45) return 1.0;
      Random random(seed * 1000003 + cell(p.x) * 10007 + cell(p.y) * 101 + cell(p.z));
      return random.uniform(-1, 1);
    };
    const TriangleMesh mesh = polygonise(noise, cube(0.6), 0.1);
    ASSERT_GT(mesh.triangles.size(), 100U);
    EXPECT_EQ(topology_of(mesh).boundaries, 0);  // and half_edges did not throw
    for (const auto& [a, b, c] : mesh.triangles) EXPECT_TRUE(a != b && b != c && c != a);
  }
}

TEST(Remesh, MakesTrianglesEvenAndKeepsTopologyAndSurface) {
  const TriangleMesh rough = polygonise(ring, cube(1.6), 0.1);
  ASSERT_EQ(topology_of(rough).genus, 1);
  const TriangleMesh mesh =
      remesh(rough, {.surface = ring, .cut = {}, .edge_length = wanted_length});
  EXPECT_EQ(topology_of(mesh).genus, 1);
  EXPECT_EQ(topology_of(mesh).boundaries, 0);
  double mean = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3d pa = mesh.positions[a], pb = mesh.positions[b], pc = mesh.positions[c];
    EXPECT_GT(triangle_quality(pa, pb, pc), 0.3);
    EXPECT_GT(length(pb - pa), 0.3 * 0.15);
    EXPECT_LT(length(pb - pa), 1.8 * 0.15);
    mean += triangle_quality(pa, pb, pc) / static_cast<double>(mesh.triangles.size());
  }
  EXPECT_GT(mean, 0.93);
  for (const Vec3d p : mesh.positions) EXPECT_NEAR(ring(p), 0, 1e-8);
}

TEST(Remesh, KeepsABorderOnItsCurve) {
  const Field plane = [](Vec3d p) { return p.y - 0.3; };
  const TriangleMesh clipped = clip(icosphere(1, 3), plane);
  EXPECT_EQ(topology_of(clipped).boundaries, 1);
  const TriangleMesh mesh =
      remesh(clipped, {.surface = unit_ball, .cut = plane, .edge_length = wanted_length});
  EXPECT_EQ(topology_of(mesh).euler, 1);
  const auto loops = border_loops(
      mesh.triangles, half_edges(static_cast<int>(mesh.positions.size()), mesh.triangles));
  ASSERT_EQ(loops.size(), 1U);
  EXPECT_GT(loops[0].size(), 30U);
  for (const int v : loops[0]) {
    EXPECT_NEAR(mesh.positions[v].y, 0.3, 1e-8);
    EXPECT_NEAR(length(mesh.positions[v]), 1, 1e-8);
  }
}

TEST(Clip, CutsTrianglesWhereTheFieldVanishes) {
  const TriangleMesh square{.positions = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}},
                            .triangles = {{0, 2, 1}, {0, 3, 2}}};
  const TriangleMesh part = clip(square, [](Vec3d p) { return p.x - 0.25; });
  EXPECT_NEAR(test::area_of(part), 0.25, 1e-15);
  for (const Vec3d p : part.positions) EXPECT_LE(p.x, 0.25 + 1e-15);
  EXPECT_EQ(topology_of(part).euler, 1);
}

TEST(EditableMesh, RefusesACollapseThatWouldChangeTheTopology) {
  // A tube of three sides, open at both ends: any ring edge closes it.
  TriangleMesh tube;
  for (int level = 0; level < 3; ++level)
    for (int i = 0; i < 3; ++i)
      tube.positions.push_back({cosine(2 * pi * i / 3), 0.5 * level, sine(2 * pi * i / 3)});
  for (int level = 0; level < 2; ++level)
    for (int i = 0; i < 3; ++i) {
      const int a = 3 * level + i, b = 3 * level + (i + 1) % 3;
      tube.triangles.push_back({a, a + 3, b});
      tube.triangles.push_back({b, a + 3, b + 3});
    }
  const EditableMesh mesh(tube);
  EXPECT_FALSE(mesh.can_collapse(3, 4)) << "a ring in the middle";
  EXPECT_FALSE(mesh.can_collapse(0, 1)) << "a border loop of three";
  EXPECT_FALSE(mesh.can_collapse(0, 7)) << "not neighbours";
  const EditableMesh tetrahedron(test::tetrahedron());
  EXPECT_FALSE(tetrahedron.can_collapse(0, 1));
}

TEST(EditableMesh, RefusesToPinchAStripBetweenTwoBorders) {
  const EditableMesh square({.positions = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}},
                             .triangles = {{0, 2, 1}, {0, 3, 2}}});
  EXPECT_FALSE(square.can_collapse(0, 2));
  EXPECT_TRUE(square.can_collapse(0, 1));
}

TEST(EditableMesh, RandomEditsKeepTheTopology) {
  EditableMesh mesh(icosphere(1, 2));
  Random random(9);
  int collapses = 0;
  for (int i = 0; i < 3000; ++i) {
    const int slot = random.index(mesh.slot_count());
    if (!mesh.is_alive(slot)) continue;
    const int a = mesh.triangle(slot)[0], b = mesh.triangle(slot)[1];
    const Vec3d middle = 0.5 * (mesh.position(a) + mesh.position(b));
    const double choice = random.uniform();
    if (choice < 0.3) {
      mesh.split(a, b, middle);
    } else if (choice < 0.4) {
      mesh.flip_if_better(a, b);
    } else if (mesh.can_collapse(a, b)) {
      mesh.collapse(a, b, middle);
      ++collapses;
    }
  }
  EXPECT_GT(collapses, 100);
  const TopologyCounts counts = topology_of(mesh.compact());
  EXPECT_EQ(counts.euler, 2);
  EXPECT_EQ(counts.boundaries, 0);
  EXPECT_EQ(counts.components, 1);
}

}  // namespace
}  // namespace weft
