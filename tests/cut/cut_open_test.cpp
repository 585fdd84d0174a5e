#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "tests/cut/cut_cases.h"
#include "tests/support/errors.h"
#include "tests/support/meshes.h"
#include "weft/cut/disk_mesh.h"
#include "weft/cut/open_to_disk.h"
#include "weft/error.h"
#include "weft/mesh/topology.h"

namespace weft {
namespace {

using test::border_size;
using test::cut_cases;
using test::one_triangle;
using test::slab_surface;
using test::tetrahedron;

/// The surface vertices of a path, first node to last.
std::vector<int> walk(const CutDisk& cut, const BorderPath& path) {
  std::vector<int> vertices;
  for (int j = 0; j <= path.edges; ++j)
    vertices.push_back(
        cut.disk.surface_vertex[cut.disk.border[(path.first + j) % border_size(cut)]]);
  return vertices;
}

void expect_paths_cover_the_border_in_order(const CutDisk& cut) {
  int next = cut.paths.front().first;
  int edges = 0;
  for (const BorderPath& path : cut.paths) {
    EXPECT_EQ(path.first, next);
    EXPECT_GE(path.edges, 1);
    next = (path.first + path.edges) % border_size(cut);
    edges += path.edges;
  }
  EXPECT_EQ(edges, border_size(cut));
}

void expect_mates_are_reversed(const CutDisk& cut) {
  for (std::size_t p = 0; p < cut.paths.size(); ++p) {
    const BorderPath& path = cut.paths[p];
    EXPECT_EQ(path.mate < 0, path.border_loop >= 0);
    if (path.mate < 0) continue;
    const BorderPath& mate = cut.paths[path.mate];
    EXPECT_EQ(mate.mate, static_cast<int>(p));
    std::vector<int> reversed = walk(cut, mate);
    std::reverse(reversed.begin(), reversed.end());
    EXPECT_EQ(walk(cut, path), reversed);
  }
}

double area(const DiskMesh& disk) { return test::area_of({disk.positions, disk.triangles}); }

std::string error_of(const TriangleMesh& mesh, const Cut& cut) {
  return test::message_of<TopologyError>([&] { cut_open(mesh, cut); });
}

TEST(CutOpen, TrianglesAndPositionsAreThoseOfTheMesh) {
  for (const auto& [name, mesh] : cut_cases()) {
    SCOPED_TRACE(name);
    if (name == "tetrahedron") continue;  // its border is too short and gets split
    const DiskMesh disk = cut_open(mesh, open_to_disk(mesh)).disk;
    ASSERT_EQ(disk.triangles.size(), mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        const int v = disk.triangles[t][k];
        EXPECT_EQ(disk.surface_vertex[v], mesh.triangles[t][k]);
        EXPECT_EQ(disk.positions[v], mesh.positions[mesh.triangles[t][k]]);
      }
  }
}

TEST(CutOpen, BorderIsTheLoopOfTheOpenedMesh) {
  for (const auto& [name, mesh] : cut_cases()) {
    SCOPED_TRACE(name);
    const DiskMesh disk = cut_open(mesh, open_to_disk(mesh)).disk;
    const auto loops = border_loops(
        disk.triangles, half_edges(static_cast<int>(disk.positions.size()), disk.triangles));
    ASSERT_EQ(loops.size(), 1U);
    std::vector<int> loop = loops[0];
    std::rotate(loop.begin(), std::find(loop.begin(), loop.end(), disk.border[0]), loop.end());
    EXPECT_EQ(loop, disk.border);
  }
}

TEST(CutOpen, PathsCoverTheBorderAndMatesWalkBack) {
  for (const auto& [name, mesh] : cut_cases()) {
    SCOPED_TRACE(name);
    const CutDisk cut = cut_open(mesh, open_to_disk(mesh));
    expect_paths_cover_the_border_in_order(cut);
    expect_mates_are_reversed(cut);
  }
}

TEST(CutOpen, PathsEndWhereTheCutBranchesOrEnds) {
  for (const auto& [name, mesh] : cut_cases()) {
    SCOPED_TRACE(name);
    const CutDisk cut = cut_open(mesh, open_to_disk(mesh));
    std::map<int, std::set<int>> neighbours;
    for (const BorderPath& path : cut.paths) {
      const std::vector<int> vertices = walk(cut, path);
      for (std::size_t j = 0; j + 1 < vertices.size(); ++j) {
        neighbours[vertices[j]].insert(vertices[j + 1]);
        neighbours[vertices[j + 1]].insert(vertices[j]);
      }
    }
    for (const BorderPath& path : cut.paths) {
      const std::vector<int> vertices = walk(cut, path);
      EXPECT_TRUE(cut.paths.size() == 1 || neighbours[vertices.front()].size() != 2);
      for (std::size_t j = 1; j + 1 < vertices.size(); ++j)
        EXPECT_EQ(neighbours[vertices[j]].size(), 2U);
    }
  }
}

TEST(CutOpen, BorderLoopsAreNumberedAsTheMeshsOwn) {
  const TriangleMesh mesh = slab_surface({"o#o", "###", "o#o"});
  const auto loops = border_loops(
      mesh.triangles, half_edges(static_cast<int>(mesh.positions.size()), mesh.triangles));
  const CutDisk cut = cut_open(mesh, open_to_disk(mesh));
  std::vector<int> edges(loops.size(), 0);
  for (const BorderPath& path : cut.paths) {
    if (path.border_loop < 0) continue;
    edges[path.border_loop] += path.edges;
    const std::vector<int>& loop = loops[path.border_loop];
    for (const int v : walk(cut, path))
      EXPECT_NE(std::find(loop.begin(), loop.end(), v), loop.end());
  }
  for (std::size_t i = 0; i < loops.size(); ++i)
    EXPECT_EQ(edges[i], static_cast<int>(loops[i].size()));
}

// A disk is left when an open disk is taken from the surface, so the cut graph has one less.
TEST(Summarise, NodesMinusPathsIsTheEulerCharacteristicLessOne) {
  for (const auto& [name, mesh] : cut_cases()) {
    SCOPED_TRACE(name);
    const CutSummary summary = summarise(cut_open(mesh, open_to_disk(mesh)));
    const int euler = count_topology(static_cast<int>(mesh.positions.size()), mesh.triangles).euler;
    EXPECT_EQ(summary.nodes - summary.paths, euler - 1);
  }
}

TEST(CutOpen, SingleEdgeOfAClosedSurfaceIsSplitSoThatNoEdgeIsDouble) {
  const CutDisk cut = cut_open(tetrahedron(), {{{0, 1}}});
  EXPECT_EQ(cut.disk.border.size(), 4U);
  ASSERT_EQ(cut.paths.size(), 2U);
  EXPECT_EQ(walk(cut, cut.paths[0]).at(1), 4);
  expect_paths_cover_the_border_in_order(cut);
  expect_mates_are_reversed(cut);
  const auto counts =
      count_topology(static_cast<int>(cut.disk.positions.size()), cut.disk.triangles);
  EXPECT_EQ(counts.euler, 1);
  EXPECT_NEAR(summarise(cut).length, 1, 1e-15);
}

TEST(CutOpen, CutsThatDoNotLeaveADiskAreRefused) {
  const TriangleMesh torus = slab_surface({"###", "#.#", "###"});
  EXPECT_EQ(error_of(torus, {}),
            "cut: the mesh opens to 1 pieces with 0 border edges and Euler characteristic 0; "
            "one disk (1 piece, Euler characteristic 1) is wanted");
  EXPECT_EQ(error_of(tetrahedron(), {{{0, 1}, {0, 2}, {1, 2}}}),
            "cut: the mesh opens to 2 pieces with 6 border edges and Euler characteristic 2; "
            "one disk (1 piece, Euler characteristic 1) is wanted");
  EXPECT_EQ(error_of(tetrahedron(), {{{0, 9}}}),
            "cut: vertices 0 and 9 share no edge; a cut along edges of the mesh is wanted");
}

TEST(SplitBorderEdge, KeepsMatesAreaAndDisk) {
  for (const auto& [name, mesh] : cut_cases()) {
    SCOPED_TRACE(name);
    CutDisk cut = cut_open(mesh, open_to_disk(mesh));
    const double before = area(cut.disk);
    const double length_before = summarise(cut).length;
    for (int i = 0; i < border_size(cut) && i < 60; i += 3) split_border_edge(cut, i, 0.3);
    expect_paths_cover_the_border_in_order(cut);
    expect_mates_are_reversed(cut);
    EXPECT_NEAR(area(cut.disk), before, 1e-12 * before);
    EXPECT_NEAR(summarise(cut).length, length_before, 1e-12);
    const int vertices = static_cast<int>(cut.disk.positions.size());
    const TopologyCounts counts = count_topology(vertices, cut.disk.triangles);
    EXPECT_EQ(counts.euler, 1);
    EXPECT_EQ(counts.boundaries, 1);
  }
}

TEST(SplitBorderEdge, PutsTheVertexAtTheFractionFromTheStart) {
  CutDisk cut = cut_open(one_triangle(), {});
  const Vec3d a = cut.disk.positions[cut.disk.border[2]];
  const Vec3d b = cut.disk.positions[cut.disk.border[0]];
  split_border_edge(cut, 2, 0.25);
  ASSERT_EQ(cut.disk.border.size(), 4U);
  EXPECT_EQ(cut.disk.positions[cut.disk.border[3]], a + 0.25 * (b - a));
  EXPECT_EQ(cut.disk.surface_vertex[cut.disk.border[3]], 3);
}

}  // namespace
}  // namespace weft
