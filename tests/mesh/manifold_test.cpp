#include "weft/mesh/manifold.h"

#include <algorithm>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "tests/mesh/small_meshes.h"
#include "tests/support/errors.h"
#include "tests/support/meshes.h"
#include "weft/error.h"

namespace weft {
namespace {

int vertices_of(const TriangleMesh& mesh) { return static_cast<int>(mesh.positions.size()); }

EdgeUses uses_of(const TriangleMesh& mesh) { return edge_uses(vertices_of(mesh), mesh.triangles); }

void flip(Triangle& t) { std::swap(t[1], t[2]); }

/// Pages of two triangles each that meet in the edge 0-1.
TriangleMesh book(int pages) {
  TriangleMesh mesh{{{0, 0, 0}, {0, 1, 0}}, {}};
  for (int page = 0; page < pages; ++page) {
    const double angle = 2 * pi * page / pages;
    const int low = vertices_of(mesh);
    mesh.positions.push_back({cosine(angle), 0, sine(angle)});
    mesh.positions.push_back({cosine(angle), 1, sine(angle)});
    mesh.triangles.push_back({0, low, low + 1});
    mesh.triangles.push_back({0, low + 1, 1});
  }
  return mesh;
}

/// A flat square of squares, with vertex r * (side + 1) + c.
TriangleMesh plate(int side) {
  TriangleMesh mesh;
  const auto at = [&](int r, int c) { return r * (side + 1) + c; };
  for (int r = 0; r <= side; ++r)
    for (int c = 0; c <= side; ++c) mesh.positions.push_back({1.0 * c, 1.0 * r, 0});
  for (int r = 0; r < side; ++r)
    for (int c = 0; c < side; ++c) {
      mesh.triangles.push_back({at(r, c), at(r, c + 1), at(r + 1, c + 1)});
      mesh.triangles.push_back({at(r, c), at(r + 1, c + 1), at(r + 1, c)});
    }
  return mesh;
}

int edge_between(const TriangleMesh& mesh, const EdgeUses& edges, int a, int b) {
  for (int e = 0; e < edges.edge_count(); ++e) {
    const int h = edges.of(e).front();
    const std::set ends{from_vertex(mesh.triangles, h), to_vertex(mesh.triangles, h)};
    if (ends == std::set{a, b}) return e;
  }
  return -1;
}

TEST(Manifold, TheFewerTrianglesOfEachComponentAreFlipped) {
  const TriangleMesh torus = test::torus(5, 7);
  TriangleMesh mesh = test::together(test::tetrahedron(), torus);
  const std::vector<Triangle> right = mesh.triangles;
  flip(mesh.triangles[2]);
  for (const int t : {4, 9, 17}) flip(mesh.triangles[t]);
  EXPECT_EQ(orient_triangles(mesh.triangles, uses_of(mesh), "mesh"), 4);
  const HalfEdges edges = half_edges(vertices_of(mesh), mesh.triangles);
  EXPECT_EQ(std::ranges::count(edges.twin, -1), 0);
  const auto directed = [](const Triangle& t) {
    return std::set{std::pair{t[0], t[1]}, std::pair{t[1], t[2]}, std::pair{t[2], t[0]}};
  };
  for (std::size_t t = 0; t < right.size(); ++t)
    EXPECT_EQ(directed(mesh.triangles[t]), directed(right[t])) << t;
}

TEST(Manifold, ABandOfOneSideIsRefusedByAnEdge) {
  TriangleMesh band = test::ring(9, true);
  const std::string message = test::message_of<TopologyError>(
      [&] { orient_triangles(band.triangles, uses_of(band), "band.obj"); });
  EXPECT_NE(message.find("band.obj"), std::string::npos) << message;
  EXPECT_NE(message.find("edge "), std::string::npos) << message;
}

TEST(Manifold, ABandOfOneSideIsPartedAcross) {
  TriangleMesh band = test::ring(9, true);
  std::vector<bool> parted;
  orient_parts(band.triangles, uses_of(band), parted);
  EXPECT_EQ(std::ranges::count(parted, true), 1);
  const PartedVertices made =
      part_vertices(vertices_of(band), band.triangles, uses_of(band), parted);
  EXPECT_EQ(made.source_vertex.size(), band.positions.size() + 2);
  const TopologyCounts counts =
      count_topology(static_cast<int>(made.source_vertex.size()), band.triangles);
  EXPECT_EQ(counts.components, 1);
  EXPECT_EQ(counts.boundaries, 1) << "a plain strip";
  EXPECT_EQ(counts.euler, 1);
}

TEST(Manifold, FansAroundAVertexGetCopiesOfIt) {
  // Two tetrahedra that touch at vertex 0 of the first.
  TriangleMesh mesh = test::together(test::tetrahedron(), test::tetrahedron());
  for (Triangle& t : mesh.triangles)
    for (int& v : t)
      if (v == 4) v = 0;
  const VertexSplit split = split_fans(vertices_of(mesh), mesh.triangles);
  EXPECT_EQ(split.split_vertices, 1);
  EXPECT_EQ(split.fans, 2);
  ASSERT_EQ(split.source_vertex.size(), 9U);
  EXPECT_EQ(split.source_vertex.back(), 0);
  EXPECT_EQ(count_topology(9, mesh.triangles).components, 2);
}

TEST(Manifold, PagesOfABookComeApartAndAreJoinedWhereTheyWere) {
  for (const int pages : {3, 4, 5}) {
    TriangleMesh mesh = book(pages);
    const std::vector<Triangle> whole = mesh.triangles;
    std::vector<bool> parted;
    orient_parts(mesh.triangles, uses_of(mesh), parted);
    EXPECT_EQ(std::ranges::count(parted, true), 1) << pages;
    const PartedVertices made =
        part_vertices(vertices_of(mesh), mesh.triangles, uses_of(mesh), parted);
    const int count = static_cast<int>(made.source_vertex.size());
    EXPECT_EQ(count, vertices_of(mesh) + 2 * (pages - 1));
    EXPECT_EQ(count_topology(count, mesh.triangles).components, pages);
    for (int a = 0; a < count; ++a)
      for (int b = 0; b < a; ++b)
        EXPECT_EQ(made.joined[a] == made.joined[b], made.source_vertex[a] == made.source_vertex[b]);
  }
}

TEST(Manifold, ASlitInsideOfAPieceIsLengthenedStraightOn) {
  const TriangleMesh mesh = plate(6);
  const EdgeUses edges = uses_of(mesh);
  std::vector<bool> parted(edges.edge_count(), false);
  const int middle = 3 * 7 + 3;
  parted[edge_between(mesh, edges, middle, middle + 1)] = true;
  std::vector<Triangle> stays = mesh.triangles;
  EXPECT_EQ(part_vertices(vertices_of(mesh), stays, edges, parted).source_vertex.size(),
            mesh.positions.size());
  lengthen_slits(mesh, edges, parted);
  EXPECT_EQ(std::ranges::count(parted, true), 2);
  EXPECT_TRUE(parted[edge_between(mesh, edges, middle - 1, middle)] ||
              parted[edge_between(mesh, edges, middle + 1, middle + 2)]);
  std::vector<Triangle> opens = mesh.triangles;
  EXPECT_EQ(part_vertices(vertices_of(mesh), opens, edges, parted).source_vertex.size(),
            mesh.positions.size() + 1);
}

}  // namespace
}  // namespace weft
