#include "weft/mesh/topology.h"

#include <set>

#include <gtest/gtest.h>

#include "tests/mesh/small_meshes.h"
#include "tests/support/errors.h"
#include "tests/support/meshes.h"

namespace weft {
namespace {

TEST(Topology, TetrahedronIsASphere) {
  const TopologyCounts counts = test::topology_of(test::tetrahedron());
  EXPECT_EQ(counts.vertices, 4);
  EXPECT_EQ(counts.edges, 6);
  EXPECT_EQ(counts.triangles, 4);
  EXPECT_EQ(counts.components, 1);
  EXPECT_EQ(counts.boundaries, 0);
  EXPECT_EQ(counts.euler, 2);
  EXPECT_EQ(counts.genus, 0);
}

TEST(Topology, TorusHasGenusOne) {
  const TopologyCounts counts = test::topology_of(test::torus(5, 7));
  EXPECT_EQ(counts.euler, 0);
  EXPECT_EQ(counts.genus, 1);
  EXPECT_EQ(counts.boundaries, 0);
}

TEST(Topology, GenusAddsOverComponentsAndHolesDoNotCountAsHandles) {
  TriangleMesh mesh = test::together(test::torus(5, 7), test::torus(4, 6));
  mesh.triangles.pop_back();
  mesh.triangles.erase(mesh.triangles.begin());
  mesh.positions.push_back({9, 9, 9});
  const TopologyCounts counts = test::topology_of(mesh);
  EXPECT_EQ(counts.vertices, 5 * 7 + 4 * 6);
  EXPECT_EQ(counts.components, 2);
  EXPECT_EQ(counts.boundaries, 2);
  EXPECT_EQ(counts.genus, 2);
}

TEST(Topology, TwinsRunOppositeAndOutgoingLeavesItsVertex) {
  const TriangleMesh mesh = test::ring(6, false);
  const HalfEdges edges = half_edges(static_cast<int>(mesh.positions.size()), mesh.triangles);
  for (int h = 0; h < static_cast<int>(edges.twin.size()); ++h) {
    if (edges.twin[h] < 0) continue;
    EXPECT_EQ(edges.twin[edges.twin[h]], h);
    EXPECT_EQ(from_vertex(mesh.triangles, h), to_vertex(mesh.triangles, edges.twin[h]));
  }
  for (int v = 0; v < static_cast<int>(mesh.positions.size()); ++v) {
    EXPECT_EQ(from_vertex(mesh.triangles, edges.outgoing[v]), v);
    EXPECT_LT(edges.twin[edges.outgoing[v]], 0) << "every vertex of the ring is on a border";
  }
}

TEST(Topology, TurningFromOutgoingMeetsEveryTriangleOfABorderVertex) {
  // A fan of three triangles around vertex 0, the border one not first in the list.
  const std::vector<Triangle> fan{{0, 2, 3}, {0, 3, 4}, {0, 1, 2}};
  const HalfEdges edges = half_edges(5, fan);
  std::set<int> met;
  for (int h = edges.outgoing[0]; h >= 0; h = edges.twin[HalfEdges::previous(h)])
    met.insert(HalfEdges::triangle_of(h));
  EXPECT_EQ(met, (std::set<int>{0, 1, 2}));
}

TEST(Topology, VertexWithoutTriangleHasNoOutgoingHalfEdge) {
  const std::vector<Triangle> one{{0, 1, 3}};
  EXPECT_EQ(half_edges(5, one).outgoing[2], -1);
  EXPECT_EQ(half_edges(5, one).outgoing[4], -1);
  EXPECT_EQ(count_topology(5, one).vertices, 3);
}

TEST(Topology, BorderLoopFollowsTheTrianglesDirection) {
  const std::vector<Triangle> square{{0, 1, 2}, {0, 2, 3}};
  const auto loops = border_loops(square, half_edges(4, square));
  ASSERT_EQ(loops.size(), 1U);
  EXPECT_EQ(loops[0], (std::vector<int>{0, 1, 2, 3}));
}

TEST(Topology, RingHasTwoBorderLoopsOfOneHeightEach) {
  const TriangleMesh mesh = test::ring(6, false);
  const auto loops = border_loops(
      mesh.triangles, half_edges(static_cast<int>(mesh.positions.size()), mesh.triangles));
  ASSERT_EQ(loops.size(), 2U);
  for (const auto& loop : loops) {
    EXPECT_EQ(loop.size(), 6U);
    for (const int v : loop) EXPECT_EQ(v % 2, loop[0] % 2);
  }
}

TEST(Topology, BordersThatTouchAtAVertexStayTwoLoops) {
  const std::vector<Triangle> bow_tie{{0, 1, 2}, {0, 3, 4}};
  EXPECT_EQ(border_loops(bow_tie, half_edges(5, bow_tie)).size(), 2U);
}

TEST(Topology, ComplexesThatAreManifoldsHaveTheirGenus) {
  for (const TriangleMesh& mesh : {test::tetrahedron(), test::torus(5, 7),
                                   test::together(test::torus(5, 7), test::ring(6, false))}) {
    const int vertices = static_cast<int>(mesh.positions.size());
    const TopologyCounts wanted = test::topology_of(mesh);
    const TopologyCounts counts = count_complex(vertices, mesh.triangles);
    EXPECT_EQ(counts.genus, wanted.genus);
    EXPECT_EQ(counts.euler, wanted.euler);
    EXPECT_EQ(counts.boundaries, wanted.boundaries);
  }
}

TEST(Topology, OtherComplexesHaveNoGenus) {
  const Triangle first{0, 1, 2};
  // A third triangle on an edge, one that runs the same way along it, and a second fan at a vertex.
  for (const std::vector<Triangle>& triangles :
       {std::vector<Triangle>{first, {1, 0, 3}, {0, 1, 4}}, {first, {0, 1, 3}}, {first, {0, 3, 4}}})
    EXPECT_EQ(count_complex(5, triangles).genus, -1);
}

TEST(Topology, ThirdTriangleOnAnEdgeIsRefusedByName) {
  const std::vector<Triangle> book{{4, 7, 0}, {7, 4, 1}, {4, 7, 2}};
  const std::string message = test::message_of<TopologyError>([&] { half_edges(8, book); });
  EXPECT_NE(message.find("edge 4-7 has 3 triangles"), std::string::npos) << message;
}

TEST(Topology, SameDirectionAlongAnEdgeIsRefusedByName) {
  const std::vector<Triangle> clash{{4, 7, 0}, {4, 7, 1}};
  const std::string message = test::message_of<TopologyError>([&] { half_edges(8, clash); });
  EXPECT_NE(message.find("edge 4-7"), std::string::npos) << message;
  EXPECT_NE(message.find("same direction"), std::string::npos) << message;
}

TEST(Topology, TriangleWithARepeatedVertexIsRefused) {
  const std::vector<Triangle> line{{0, 1, 2}, {3, 3, 1}};
  const std::string message = test::message_of<TopologyError>([&] { half_edges(4, line); });
  EXPECT_NE(message.find("triangle 1 has vertex 3 twice"), std::string::npos) << message;
}

}  // namespace
}  // namespace weft
