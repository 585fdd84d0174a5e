#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tests/param/layout_cases.h"
#include "weft/param/border_layout.h"

namespace weft {
namespace {

using test::border_size;
using test::Case;
using test::layout_cases;
using test::one_triangle;
using test::slab_surface;

struct LaidOut {
  CutDisk cut;
  BorderLayout layout;
  std::vector<double> positions;
};

LaidOut laid_out(CutDisk cut, const LayoutOptions& options) {
  BorderLayout layout = lay_out_border(cut, options);
  split_at_corners(cut, layout);
  std::vector<double> positions = border_positions(cut, layout);
  return {std::move(cut), std::move(layout), std::move(positions)};
}

TEST(SplitAtCorners, EveryCornerIsABorderVertexAndTheDiskStaysOne) {
  for (const Case& c : layout_cases())
    for (int rotation = 0; rotation < 16; ++rotation) {
      SCOPED_TRACE(c.name + ", rotation " + std::to_string(rotation));
      const auto [cut, layout, t] = laid_out(c.cut, {17, rotation});
      for (const int corner : {0, 16, 32, 48})
        EXPECT_EQ(std::count(t.begin(), t.end(), static_cast<double>(corner)), 1);
      const int vertices = static_cast<int>(cut.disk.positions.size());
      const TopologyCounts counts = count_topology(vertices, cut.disk.triangles);
      EXPECT_EQ(counts.euler, 1);
      EXPECT_EQ(counts.boundaries, 1);
      EXPECT_LE(cut.disk.border.size(), c.cut.disk.border.size() + 8);
    }
}

TEST(SplitAtCorners, SplittingAgainChangesNothing) {
  for (const Case& c : layout_cases()) {
    SCOPED_TRACE(c.name);
    CutDisk cut = c.cut;
    const BorderLayout layout = lay_out_border(cut, {21, 5});
    split_at_corners(cut, layout);
    CutDisk again = cut;
    split_at_corners(again, layout);
    EXPECT_EQ(again.disk.border, cut.disk.border);
    EXPECT_EQ(again.disk.triangles, cut.disk.triangles);
  }
}

TEST(BorderPositions, IncreaseAroundTheBorderWithNodesOnSamples) {
  for (const Case& c : layout_cases()) {
    SCOPED_TRACE(c.name);
    const auto [cut, layout, t] = laid_out(c.cut, {19, 7});
    const int first = cut.paths.front().first;
    int wraps = 0;
    for (int j = 0; j < border_size(cut); ++j) {
      const double here = t[(first + j) % border_size(cut)];
      const double next = t[(first + j + 1) % border_size(cut)];
      EXPECT_NE(here, next);
      wraps += next < here ? 1 : 0;
    }
    EXPECT_EQ(wraps, 1);
    for (std::size_t p = 0; p < cut.paths.size(); ++p)
      EXPECT_EQ(t[cut.paths[p].first], layout.first[p]);
  }
}

TEST(BorderPositions, MatesCorrespondExactly) {
  for (const Case& c : layout_cases()) {
    SCOPED_TRACE(c.name);
    const auto [cut, layout, t] = laid_out(c.cut, {19, 7});
    const double around = 4.0 * 18;
    for (std::size_t p = 0; p < cut.paths.size(); ++p) {
      const BorderPath& path = cut.paths[p];
      if (path.mate < 0) continue;
      const BorderPath& mate = cut.paths[path.mate];
      for (int j = 1; j < path.edges; ++j) {
        const int here = (path.first + j) % border_size(cut);
        const int there = (mate.first + path.edges - j) % border_size(cut);
        double along = t[here] - layout.first[p];
        double back = t[there] - layout.first[path.mate];
        along += along < 0 ? around : 0;
        back += back < 0 ? around : 0;
        EXPECT_EQ(along + back, layout.intervals[p]);
        EXPECT_EQ(cut.disk.surface_vertex[cut.disk.border[here]],
                  cut.disk.surface_vertex[cut.disk.border[there]]);
        EXPECT_EQ(cut.disk.positions[cut.disk.border[here]],
                  cut.disk.positions[cut.disk.border[there]]);
      }
    }
  }
}

TEST(BorderPositions, FollowArcLength) {
  CutDisk cut = cut_open(one_triangle(), {});  // sides 1, sqrt 2, 1 from the origin on
  const BorderLayout layout = lay_out_border(cut, {257, 0});
  const double whole = 2 + std::sqrt(2.0);
  const std::vector<double> t = border_positions(cut, layout);
  EXPECT_EQ(t[0], 0);
  EXPECT_NEAR(t[1], 1024 / whole, 1e-9);
  EXPECT_NEAR(t[2], 1024 * (1 + std::sqrt(2.0)) / whole, 1e-9);
  split_at_corners(cut, layout);
  ASSERT_EQ(cut.disk.border.size(), 6U);
  const Vec3d corner = cut.disk.positions[cut.disk.border[1]];
  EXPECT_NEAR(corner.x, 256 * whole / 1024, 1e-12);
}

/// Whether every corner of a chart of 5 x 5 samples is a vertex of a triangle's border.
bool corners_are_vertices(const TriangleMesh& triangle) {
  CutDisk cut = cut_open(triangle, {});
  const BorderLayout layout = lay_out_border(cut, {5, 0});
  split_at_corners(cut, layout);
  const std::vector<double> t = border_positions(cut, layout);
  const std::array<int, 4> corners = layout.size.corners();
  return std::is_sorted(t.begin(), t.end()) &&
         std::all_of(corners.begin(), corners.end(), [&](int corner) {
           return std::count(t.begin(), t.end(), static_cast<double>(corner)) == 1;
         });
}

TEST(BorderPositions, CornersAreVerticesHoweverCoordinatesRound) {
  TriangleMesh mesh = one_triangle();
  EXPECT_TRUE(corners_are_vertices(mesh));
  for (const double size : {1e-9, 1e-11, 1e-12, 0.0}) {
    mesh.positions = {{8000, 1, 1}, {8000 + size, 1, 1}, {8000, 1 + 1e-3 * size, 1}};
    EXPECT_TRUE(corners_are_vertices(mesh)) << size;
  }
}

TEST(BorderPositions, EdgesOfNoLengthStillAdvance) {
  TriangleMesh mesh = slab_surface({"o###", "####"});
  const CutDisk before = cut_open(mesh, {});
  const int a = before.disk.surface_vertex[before.disk.border[1]];
  const int b = before.disk.surface_vertex[before.disk.border[2]];
  mesh.positions[a] = mesh.positions[b];
  const std::vector<double> t = laid_out(cut_open(mesh, {}), {33, 0}).positions;
  for (std::size_t i = 0; i + 1 < t.size(); ++i) EXPECT_LT(t[i], t[i + 1]);
}

}  // namespace
}  // namespace weft
