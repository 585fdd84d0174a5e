#include "weft/mesh_statistics.h"

#include <gtest/gtest.h>

#include "tests/mesh/small_meshes.h"
#include "weft/shapes.h"

namespace weft {
namespace {

TEST(MeshStatistics, BandIsOrientableMoebiusStripIsNot) {
  EXPECT_TRUE(examine_mesh(test::ring(8, false)).orientable);
  EXPECT_FALSE(examine_mesh(test::ring(8, true)).orientable);
  EXPECT_EQ(examine_mesh(test::ring(8, false)).border_edges, 16);
  EXPECT_EQ(examine_mesh(test::ring(8, false)).inconsistent_edges, 0);
}

TEST(MeshStatistics, TurnedTriangleIsInconsistentButOrientable) {
  TriangleMesh mesh = test::ring(8, false);
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  const MeshStatistics statistics = examine_mesh(mesh);
  EXPECT_EQ(statistics.inconsistent_edges, 2);
  EXPECT_TRUE(statistics.orientable);
}

TEST(MeshStatistics, CountsNonManifoldPlacesAndComponents) {
  // Three triangles on edge 0-1, and two apart that touch in vertex 5 only.
  const TriangleMesh mesh{{{0, 0, 0},
                           {1, 0, 0},
                           {0, 1, 0},
                           {0, 0, 1},
                           {0, -1, 0},
                           {5, 0, 0},
                           {6, 0, 0},
                           {6, 1, 0},
                           {4, 0, 0},
                           {4, 1, 0}},
                          {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {5, 6, 7}, {5, 9, 8}}};
  const MeshStatistics statistics = examine_mesh(mesh);
  EXPECT_EQ(statistics.nonmanifold_edges, 1);
  EXPECT_EQ(statistics.nonmanifold_edge_list.front(), (std::array{0, 1}));
  EXPECT_EQ(statistics.nonmanifold_vertex_list, std::vector<int>{5});
  EXPECT_EQ(statistics.components, 3);
}

// The bow tie of two rings that touch: two borders stay two where they meet in a vertex.
TEST(MeshStatistics, BordersThatTouchInAVertexStayApart) {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}},
                          {{0, 1, 2}, {0, 3, 4}}};
  const MeshStatistics statistics = examine_mesh(mesh);
  ASSERT_EQ(statistics.border_loops.size(), 2U);
  EXPECT_EQ(statistics.border_loops[0].edges, 3);
  EXPECT_NEAR(statistics.border_loops[0].length, 2 + std::sqrt(2.0), 1e-12);
  EXPECT_EQ(statistics.component_list.size(), 2U);
  EXPECT_EQ(statistics.component_list[1].boundaries, 1);
  EXPECT_FALSE(statistics.closed);
}

TEST(MeshStatistics, TellsGenusBoxAreaAndVolumeOfATorus) {
  const TriangleMesh torus = make_shape("torus");
  const MeshStatistics statistics = examine_mesh(torus);
  ASSERT_EQ(statistics.component_list.size(), 1U);
  EXPECT_EQ(statistics.component_list[0].genus(), 1);
  EXPECT_EQ(statistics.component_list[0].euler(), 0);
  EXPECT_TRUE(statistics.closed);
  EXPECT_EQ(statistics.self_intersections, 0);
  TriangleMesh turned = torus;
  for (Triangle& t : turned.triangles) std::swap(t[0], t[1]);
  ASSERT_TRUE(statistics.volume && examine_mesh(turned).volume);
  EXPECT_GT(*statistics.volume, 0);
  EXPECT_NEAR(*examine_mesh(turned).volume, -*statistics.volume, 1e-12);
  EXPECT_GT(statistics.area, 0);
}

TEST(MeshStatistics, MoebiusStripHasOneBorderAndNoGenus) {
  const MeshStatistics statistics = examine_mesh(test::ring(8, true));
  ASSERT_EQ(statistics.border_loops.size(), 1U);
  EXPECT_EQ(statistics.border_loops[0].edges, 16);
  EXPECT_EQ(statistics.component_list[0].euler(), 0);
  EXPECT_FALSE(statistics.component_list[0].genus());
}

TEST(MeshStatistics, CountsWhatIsBrokenInElements) {
  TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}, {2, 0, 0}, {std::nan(""), 0, 0}},
                    {{0, 1, 2}, {2, 0, 1}, {0, 0, 1}, {0, 1, 4}}};
  const MeshStatistics statistics = examine_mesh(mesh);
  EXPECT_EQ(statistics.duplicate_triangles, 1);
  EXPECT_EQ(statistics.repeated_vertex_triangles, 1);
  EXPECT_EQ(statistics.zero_area_triangles, 1);
  EXPECT_EQ(statistics.unreferenced_vertices, 2);
  EXPECT_EQ(statistics.not_finite_vertices, 1);
  EXPECT_EQ(statistics.box.upper, (Vec3d{2, 1, 0}));
  // The twins lie in one plane; their numbers are those of the whole mesh.
  EXPECT_EQ(statistics.self_intersections, 1);
  EXPECT_EQ(statistics.self_intersection_list, (std::vector<std::array<int, 2>>{{0, 1}}));
  mesh.positions[5] = {9, 9, 9};
  EXPECT_EQ(examine_mesh(mesh).coincident_vertices, 1);
}

TEST(MeshStatistics, ListsTheFirstCrossingsAndCountsAll) {
  // One triangle that 50 others pass through.
  TriangleMesh mesh{{{0, 0, 0}, {100, 0, 0}, {0, 100, 0}}, {{0, 1, 2}}};
  for (int i = 0; i < 50; ++i) {
    const double x = 1 + 0.5 * i;
    for (const Vec3d p : {Vec3d{x, 1, -1}, Vec3d{x, 2, -1}, Vec3d{x, 1, 1}})
      mesh.positions.push_back(p);
    mesh.triangles.push_back({3 + 3 * i, 4 + 3 * i, 5 + 3 * i});
  }
  const MeshStatistics statistics = examine_mesh(mesh);
  EXPECT_EQ(statistics.self_intersections, 50);
  EXPECT_EQ(statistics.intersecting_triangles, 51);
  ASSERT_EQ(statistics.self_intersection_list.size(), 20U);
  for (int i = 0; i < 20; ++i)
    EXPECT_EQ(statistics.self_intersection_list[i], (std::array{0, i + 1}));
}

TEST(MeshStatistics, QualityIsOneForEquilateralAndFallsForSlivers) {
  EXPECT_NEAR(triangle_quality({0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}), 1, 1e-15);
  EXPECT_EQ(triangle_quality({0, 0, 0}, {1, 0, 0}, {2, 0, 0}), 0);
  const MeshStatistics statistics =
      examine_mesh({{{0, 0, 0}, {1, 0, 0}, {0.5, 1e-4, 0}}, {{0, 1, 2}}});
  EXPECT_EQ(statistics.slivers, 1);
}

}  // namespace
}  // namespace weft
