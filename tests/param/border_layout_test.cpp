#include "weft/param/border_layout.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <string>

#include <gtest/gtest.h>

#include "tests/param/layout_cases.h"
#include "weft/error.h"
#include "weft/param/border_curves.h"

namespace weft {
namespace {

using test::border_size;
using test::Case;
using test::layout_cases;
using test::slab_surface;

TEST(BorderPoint, RunsCounterClockwiseFromTheOriginThroughTheCorners) {
  EXPECT_EQ(border_point(9, 0), (Vec2d{0, 0}));
  EXPECT_EQ(border_point(9, 2.5), (Vec2d{2.5, 0}));
  EXPECT_EQ(border_point(9, 8), (Vec2d{8, 0}));
  EXPECT_EQ(border_point(9, 10), (Vec2d{8, 2}));
  EXPECT_EQ(border_point(9, 16), (Vec2d{8, 8}));
  EXPECT_EQ(border_point(9, 19), (Vec2d{5, 8}));
  EXPECT_EQ(border_point(9, 24), (Vec2d{0, 8}));
  EXPECT_EQ(border_point(9, 31), (Vec2d{0, 1}));
  EXPECT_EQ(border_point(9, 32), (Vec2d{0, 0}));
}

TEST(BorderPoint, OfARectangleHasItsCornersAndItsInverse) {
  const ChartSize size(5, 17);
  EXPECT_EQ(size.around(), 40);
  EXPECT_EQ(border_point(size, 16), (Vec2d{16, 0}));
  EXPECT_EQ(border_point(size, 20), (Vec2d{16, 4}));
  EXPECT_EQ(border_point(size, 36), (Vec2d{0, 4}));
  for (double t = 0; t < 40; t += 0.375)
    EXPECT_EQ(border_position_of(size, border_point(size, t)), t);
  for (int t = 0; t < 40; ++t) {
    const Vec2d p = border_point(size, t);
    EXPECT_EQ(chart_sample(size, t, 17), static_cast<int>(p.y) * 17 + static_cast<int>(p.x));
  }
}

TEST(LayOutBorder, OfARectangleFillsItInStepsThatItsSidesHave) {
  for (const Case& c : layout_cases()) {
    const int side = (min_size(c.cut) + 63) / 64 * 64;
    for (const ChartSize size : {ChartSize(65, 16 * side + 1), ChartSize(4 * side + 1, 33)}) {
      const BorderLayout layout = lay_out_border(c.cut, {size, 7});
      EXPECT_EQ(std::accumulate(layout.intervals.begin(), layout.intervals.end(), 0), size.around())
          << c.name;
    }
  }
}

TEST(LayOutBorder, CountsFillTheSquareMatesMatchAndPathsFollowOn) {
  for (const Case& c : layout_cases()) {
    SCOPED_TRACE(c.name);
    for (const int n : {min_size(c.cut), min_size(c.cut) + 1, 33, 257}) {
      const BorderLayout layout = lay_out_border(c.cut, {n, 3});
      const int around = 4 * (n - 1);
      EXPECT_EQ(std::accumulate(layout.intervals.begin(), layout.intervals.end(), 0), around);
      int next = 3;
      for (std::size_t p = 0; p < c.cut.paths.size(); ++p) {
        EXPECT_EQ(layout.first[p], next);
        next = (next + layout.intervals[p]) % around;
        const int mate = c.cut.paths[p].mate;
        EXPECT_EQ(layout.intervals[p], layout.intervals[mate >= 0 ? mate : p]);
      }
    }
  }
}

TEST(LayOutBorder, CountsAreProportionalToLengthUpToOneInterval) {
  for (const Case& c : layout_cases()) {
    SCOPED_TRACE(c.name);
    const BorderLayout layout = lay_out_border(c.cut, {1025, 0, false});
    const std::vector<BorderCurve> curves = border_curves(c.cut);
    double whole = 0;
    for (const BorderCurve& curve : curves) whole += curve.weight * curve.length;
    // Parity may take a path of the true border one further.
    for (const BorderCurve& curve : curves)
      EXPECT_NEAR(layout.intervals[curve.path], 4096 * curve.length / whole, 2);
  }
}

TEST(LayOutBorder, AlignedCountsAreMultiplesNearTheirShares) {
  int aligned = 0;
  for (const Case& c : layout_cases()) {
    SCOPED_TRACE(c.name);
    const std::vector<int> plain = lay_out_border(c.cut, {1025, 0, false}).intervals;
    const std::vector<int> counts = lay_out_border(c.cut, {1025, 0}).intervals;
    aligned += std::all_of(counts.begin(), counts.end(), [](int k) { return k % 4 == 0; }) ? 1 : 0;
    for (std::size_t p = 0; p < counts.size(); ++p)
      EXPECT_NEAR(counts[p], plain[p], plain[p] / 32.0 + 2);
  }
  EXPECT_GE(aligned, 20);  // of 36: those whose paths are long enough
}

TEST(LayOutBorder, EqualLoopsOfATorusMeetOnTheHighestLevel) {
  const TriangleMesh mesh = slab_surface({"###", "#.#", "###"});
  const CutDisk cut = cut_open(mesh, open_to_disk(mesh));
  const BorderLayout layout = lay_out_border(cut, {257, 64});
  const int step = 16;
  for (std::size_t p = 0; p < cut.paths.size(); ++p) {
    EXPECT_EQ(layout.intervals[p] % step, 0) << layout.intervals[p];
    EXPECT_EQ(layout.first[p] % step, 0);
  }
}

TEST(LayOutBorder, WhatFixedBordersLeaveIsSharedOutToMates) {
  // A ring whose outer and inner border are fixed: only the cut between them, which runs along the
  // border twice, takes what is left.
  int rings = 0;
  for (Case& c : layout_cases()) {
    int intervals = 4, borders = 0;
    for (BorderPath& path : c.cut.paths)
      if (path.mate < 0) {
        path.intervals = intervals;
        intervals += 4;
        ++borders;
      }
    if (borders < 2 || !has_free_path(c.cut) || min_size(c.cut) > 129) continue;
    ++rings;
    const BorderLayout layout = lay_out_border(c.cut, {129, 0});
    EXPECT_EQ(std::accumulate(layout.intervals.begin(), layout.intervals.end(), 0), 4 * 128);
    for (std::size_t p = 0; p < c.cut.paths.size(); ++p) {
      if (c.cut.paths[p].mate >= 0) continue;
      EXPECT_EQ(layout.intervals[p], c.cut.paths[p].intervals) << c.name;
    }
  }
  EXPECT_GE(rings, 3);
}

TEST(LayOutBorder, LeastCountsKeepLoopsAndParallelPathsApart) {
  for (const Case& c : layout_cases()) {
    SCOPED_TRACE(c.name);
    const BorderLayout layout = lay_out_border(c.cut, {min_size(c.cut), 0});
    std::map<int, int> loops;
    std::map<std::pair<int, int>, int> single;
    for (std::size_t p = 0; p < c.cut.paths.size(); ++p) {
      const BorderPath& path = c.cut.paths[p];
      const auto node = [&](int j) {
        return c.cut.disk.surface_vertex[c.cut.disk.border[(path.first + j) % border_size(c.cut)]];
      };
      if (path.border_loop >= 0) loops[path.border_loop] += layout.intervals[p];
      if (path.mate >= 0 && path.mate < static_cast<int>(p)) continue;
      const auto [a, b] = std::minmax({node(0), node(path.edges)});
      EXPECT_GE(layout.intervals[p], a == b ? 3 : 1);
      single[{a, b}] += layout.intervals[p] == 1 ? 1 : 0;
    }
    for (const auto& [loop, intervals] : loops) EXPECT_GE(intervals, 3);
    for (const auto& [ends, count] : single) EXPECT_LE(count, 1);
  }
}

TEST(LayOutBorder, TooSmallASizeIsRefusedNamingTheLeast) {
  const TriangleMesh mesh = slab_surface({"#####", "#.#.#", "#####", "#.#.#", "#####"}, 1.7);
  const CutDisk cut = cut_open(mesh, open_to_disk(mesh));
  const int least = min_size(cut);
  EXPECT_GT(least, 5);
  EXPECT_NO_THROW(lay_out_border(cut, {least, 0}));
  try {
    lay_out_border(cut, {least - 1, 0});
    FAIL() << "a size below the least was taken";
  } catch (const TopologyError& error) {
    const std::string wanted = "; size " + std::to_string(least) + " or more";
    EXPECT_NE(std::string(error.what()).find(wanted), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace weft
