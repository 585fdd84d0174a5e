#include "weft/mesh/facts.h"

#include <gtest/gtest.h>

#include "tests/mesh/small_meshes.h"

namespace weft {
namespace {

TEST(MeshFacts, BandIsOrientableMoebiusStripIsNot) {
  EXPECT_TRUE(examine_mesh(test::ring(8, false)).orientable);
  EXPECT_FALSE(examine_mesh(test::ring(8, true)).orientable);
  EXPECT_EQ(examine_mesh(test::ring(8, false)).border_edges, 16);
  EXPECT_EQ(examine_mesh(test::ring(8, false)).inconsistent_edges, 0);
}

TEST(MeshFacts, TurnedTriangleIsInconsistentButOrientable) {
  TriangleMesh mesh = test::ring(8, false);
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  const MeshFacts facts = examine_mesh(mesh);
  EXPECT_EQ(facts.inconsistent_edges, 2);
  EXPECT_TRUE(facts.orientable);
}

TEST(MeshFacts, CountsNonManifoldPlacesAndComponents) {
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
  const MeshFacts facts = examine_mesh(mesh);
  EXPECT_EQ(facts.nonmanifold_edges, 1);
  EXPECT_EQ(facts.nonmanifold_edge_list.front(), (std::array{0, 1}));
  EXPECT_EQ(facts.nonmanifold_vertex_list, std::vector<int>{5});
  EXPECT_EQ(facts.components, 3);
}

TEST(MeshFacts, QualityIsOneForEquilateralAndFallsForSlivers) {
  EXPECT_NEAR(triangle_quality({0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}), 1, 1e-15);
  EXPECT_EQ(triangle_quality({0, 0, 0}, {1, 0, 0}, {2, 0, 0}), 0);
  const MeshFacts facts = examine_mesh({{{0, 0, 0}, {1, 0, 0}, {0.5, 1e-4, 0}}, {{0, 1, 2}}});
  EXPECT_EQ(facts.slivers, 1);
}

}  // namespace
}  // namespace weft
