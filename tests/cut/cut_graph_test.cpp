#include "weft/cut/cut_graph.h"

#include <algorithm>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "tests/cut/cut_cases.h"
#include "tests/support/errors.h"
#include "weft/error.h"

namespace weft {
namespace {

/// The half-edge that leaves one vertex for another.
int half_edge_between(const CutSurface& surface, int from, int to) {
  for (int h = 0; h < surface.half_edge_count(); ++h)
    if (surface.from(h) == from && surface.to(h) == to) return h;
  return -1;
}

int open_edges(const CutGraph& graph) {
  int open = 0;
  for (int h = 0; h < graph.surface().half_edge_count(); ++h)
    if (graph.contains(h) && graph.surface().edge_name(h) == h) ++open;
  return open;
}

TEST(CutGraph, BeginsWithTheBorderWhichNothingCloses) {
  for (const auto& [name, mesh] : test::cut_cases()) {
    const CutSurface surface(mesh);
    CutGraph graph(surface);
    const auto on_border = [&](int h) { return surface.twin(h) < 0; };
    for (int h = 0; h < surface.half_edge_count(); ++h) {
      EXPECT_EQ(graph.contains(h), on_border(h)) << name;
      graph.remove(h);
      EXPECT_EQ(graph.contains(h), on_border(h)) << name;
    }
    EXPECT_EQ(graph.length(), 0) << name;
  }
}

TEST(CutGraph, AnEdgeIsOpenFromBothSidesAndOnceOnly) {
  const TriangleMesh mesh = test::tetrahedron();
  const CutSurface surface(mesh);
  CutGraph graph(surface);
  const int h = half_edge_between(surface, 0, 1);
  graph.add(h);
  graph.add(surface.twin(h));
  EXPECT_TRUE(graph.contains(surface.twin(h)));
  EXPECT_EQ(graph.valence(0), 1);
  EXPECT_EQ(graph.valence(1), 1);
  EXPECT_EQ(graph.valence(2), 0);
  EXPECT_EQ(graph.length(), 1);
  EXPECT_EQ(graph.first_open(half_edge_between(surface, 2, 3)), -1);
  graph.remove(surface.twin(h));
  EXPECT_EQ(open_edges(graph), 0);
}

TEST(CutGraph, AllEdgesOpenLeaveEveryTriangleAlone) {
  for (const auto& [name, mesh] : test::cut_cases()) {
    const CutSurface surface(mesh);
    CutGraph graph(surface);
    EXPECT_EQ(graph.piece_count(), test::topology_of(mesh).components) << name;
    graph.add_all();
    EXPECT_EQ(graph.piece_count(), surface.triangle_count()) << name;
    for (int h = 0; h < surface.half_edge_count(); ++h)
      EXPECT_EQ(graph.next_open(h), HalfEdges::next(h)) << name;
  }
}

TEST(CutGraph, PruningLeavesWhatClosesAndWhatIsHeld) {
  const TriangleMesh mesh = test::torus(6, 8);
  const CutSurface surface(mesh);
  CutGraph graph(surface);
  // Once round the torus, and an edge that dangles from it.
  for (int j = 0; j < 8; ++j) graph.add(half_edge_between(surface, j, (j + 1) % 8));
  const int dangling = half_edge_between(surface, 0, 8);
  graph.add(dangling);
  graph.prune();
  EXPECT_FALSE(graph.contains(dangling));
  EXPECT_EQ(open_edges(graph), 8);
  graph.add(dangling);
  graph.hold();
  graph.remove(dangling);
  graph.prune();
  EXPECT_TRUE(graph.contains(dangling));
  EXPECT_TRUE(graph.is_held(surface.twin(dangling)));
}

TEST(CutGraph, PathsRunFromNodeToNodeAndHoldEveryInteriorEdgeOnce) {
  for (const auto& [name, mesh] : test::cut_cases()) {
    const CutSurface surface(mesh);
    const CutGraph graph(surface, open_to_disk(mesh));
    std::set<int> met;
    double length = 0;
    for (const std::vector<int>& path : graph.paths()) {
      for (std::size_t k = 0; k < path.size(); ++k) {
        EXPECT_TRUE(graph.contains(path[k])) << name;
        EXPECT_TRUE(met.insert(surface.edge_name(path[k])).second) << name;
        if (k > 0) {
          EXPECT_EQ(surface.to(path[k - 1]), surface.from(path[k])) << name;
        }
        length += surface.length(path[k]);
      }
      EXPECT_EQ(graph.path_through(path[path.size() / 2]).size(), path.size()) << name;
    }
    EXPECT_EQ(met.size(), graph.cut().edges.size()) << name;
    EXPECT_NEAR(length, graph.length(), 1e-12) << name;
    EXPECT_EQ(graph.piece_count(), 1) << name;
  }
}

TEST(CutGraph, ACutOfAnotherMeshIsRefusedByItsEdge) {
  const TriangleMesh mesh = test::torus(6, 8);
  const CutSurface surface(mesh);
  const std::string message = test::message_of<TopologyError>([&] {
    CutGraph(surface, Cut{{{0, 20}}});
  });
  EXPECT_NE(message.find("20"), std::string::npos) << message;
}

}  // namespace
}  // namespace weft
