#include "weft/cut/seam.h"

#include <algorithm>
#include <array>
#include <numeric>

#include <gtest/gtest.h>

#include "tests/support/errors.h"
#include "tests/support/meshes.h"
#include "weft/error.h"

namespace weft {
namespace {

using Edges = std::vector<std::array<int, 2>>;

std::string refusal(std::string_view text) {
  return test::message_of<InputError>([&] { parse_seam(text, "seam.txt"); });
}

SeamCut cut_of(const TriangleMesh& mesh, std::string_view seam) {
  std::vector<int> same(mesh.positions.size());
  std::iota(same.begin(), same.end(), 0);
  return cut_along_seam(mesh, same, parse_seam(seam, "seam.txt"));
}

/// A torus of 6 x 5 vertices and its seam along a ring and across the tube.
TriangleMesh small_torus() { return test::torus(6, 5); }
const std::string torus_seam = "0 5 10 15 20 25 0  # along\n0 1 2 3 4 0\n";

bool holds(const Cut& cut, const Edges& edges) {
  return std::all_of(edges.begin(), edges.end(), [&](const std::array<int, 2>& edge) {
    return std::find(cut.edges.begin(), cut.edges.end(), edge) != cut.edges.end();
  });
}

TEST(ParseSeam, PathsComeALineEachWithComments) {
  const Seam seam = parse_seam("# along the back\n\n 0 5\t10 # first\n3 4\r\n", "seam.txt");
  ASSERT_EQ(seam.paths.size(), 2U);
  EXPECT_EQ(seam.name, "seam.txt");
  EXPECT_EQ(seam.paths[0].vertices, (std::vector<int>{0, 5, 10}));
  EXPECT_EQ(seam.paths[0].line, 3);
  EXPECT_EQ(seam.paths[1].vertices, (std::vector<int>{3, 4}));
  EXPECT_EQ(seam.paths[1].line, 4);
}

TEST(ParseSeam, ByteOrderMarksDoNotMatter) {
  const std::string utf16(
      "\xff\xfe"
      "0\0 \0"
      "7\0\n\0",
      10);
  for (const std::string& text : {std::string("\xef\xbb\xbf"
                                              "0 7\n"),
                                  utf16})
    EXPECT_EQ(parse_seam(text, "seam.txt").paths[0].vertices, (std::vector<int>{0, 7}));
}

TEST(ParseSeam, WhatIsNoPathIsRefusedWithItsLine) {
  EXPECT_EQ(refusal("# nothing\n"), "seam.txt: has no path; a line of vertex numbers is wanted");
  EXPECT_EQ(refusal("0 1\n7\n"),
            "seam.txt:2: a path of one vertex; at least two vertices are wanted");
  EXPECT_EQ(refusal("0 1\n\n2 x\n"), "seam.txt:3: 'x'; vertex numbers from 0 are wanted");
  EXPECT_EQ(refusal("0 -1\n"), "seam.txt:1: '-1'; vertex numbers from 0 are wanted");
  EXPECT_EQ(refusal("0 99999999999\n"),
            "seam.txt:1: '99999999999'; vertex numbers from 0 are wanted");
}

TEST(Seam, OneThatOpensTheMeshToADiskIsTheWholeCut) {
  const SeamCut made = cut_of(small_torus(), torus_seam);
  EXPECT_EQ(made.added_edges, 0);
  EXPECT_EQ(made.cut.edges, (Edges{{0, 1},
                                   {0, 4},
                                   {0, 5},
                                   {0, 25},
                                   {1, 2},
                                   {2, 3},
                                   {3, 4},
                                   {5, 10},
                                   {10, 15},
                                   {15, 20},
                                   {20, 25}}));
  EXPECT_EQ(cut_open(small_torus(), made.cut).disk.border.size(), 22U);
}

TEST(Seam, OneThatDoesNotSufficeIsKeptAndCompleted) {
  const TriangleMesh torus = small_torus();
  const SeamCut made = cut_of(torus, "0 1 2 3 4 0\n");
  EXPECT_TRUE(holds(made.cut, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {0, 4}}));
  EXPECT_EQ(made.added_edges, 6);  // the shortest way once around
  EXPECT_EQ(made.cut.edges.size(), 11U);
  cut_open(torus, made.cut);
  // Two pieces that do not meet are joined, and their loose ends stay.
  const SeamCut apart = cut_of(torus, "0 1 2\n17 18 13\n");
  EXPECT_TRUE(holds(apart.cut, {{0, 1}, {1, 2}, {17, 18}, {13, 18}}));
  cut_open(torus, apart.cut);
  const SeamCut slit = cut_of(test::tetrahedron(), "2 3");
  EXPECT_EQ(slit.added_edges, 0);
  EXPECT_EQ(slit.cut.edges, (Edges{{2, 3}}));
}

TEST(Seam, VerticesWithoutACommonEdgeAreJoinedByTheShortestPath) {
  const SeamCut made = cut_of(small_torus(), "0 10 20 0\n0 2 4 0\n");
  EXPECT_EQ(made.added_edges, 0);
  EXPECT_EQ(cut_open(small_torus(), made.cut).disk.border.size(), 2 * made.cut.edges.size());
}

TEST(Seam, NumbersAreThoseOfTheInputAndCopiesServeAsOne) {
  // Numbers run backward, and two vertices of the mesh are one of the input.
  const TriangleMesh torus = small_torus();
  std::vector<int> source(30);
  for (int v = 0; v < 30; ++v) source[v] = 29 - v;
  source[12] = source[0];
  const Seam seam = parse_seam("29 28 27", "seam.txt");
  const SeamCut made = cut_along_seam(torus, source, seam);
  EXPECT_TRUE(holds(made.cut, {{0, 1}, {1, 2}}));
  EXPECT_EQ(test::message_of<InputError>(
                [&] { cut_along_seam(torus, source, parse_seam("29 28\n28 17", "seam.txt")); }),
            "seam.txt:2: vertex 17 is not in the mesh; vertices of the surface that is converted, "
            "from 0 to 29 in the order of its file, are wanted");
}

TEST(Seam, OneThatCutsTheSurfaceInPiecesIsRefusedWithItsLine) {
  EXPECT_EQ(test::message_of<InputError>([] { cut_of(small_torus(), "0 1\n\n7 8 13 7\n20 21\n"); }),
            "seam.txt:3: this path cuts the surface in pieces; a seam that leaves it in one piece "
            "is wanted");
  EXPECT_EQ(test::message_of<InputError>(
                [] { cut_of(small_torus(), torus_seam + "2 7 12 17 22 27 2\n"); }),
            "seam.txt:3: this path cuts the surface in pieces; a seam that leaves it in one piece "
            "is wanted");
}

}  // namespace
}  // namespace weft
