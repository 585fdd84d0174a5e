#include "weft/collide/broad_phase/unfolded_blocks.h"

#include <gtest/gtest.h>

#include "tests/cloth/cut_sheet.h"
#include "weft/collide/broad_phase/coherent_pairs.h"
#include "weft/collide/broad_phase/pyramid_pairs.h"
#include "weft/collide/broad_phase/unfolded_windows.h"
#include "weft/core/random.h"
#include "weft/mesh/crossings.h"

namespace weft {
namespace {

using testing::CutSheet;

constexpr int whole = 33;

Grid<Diagonal> diagonals_of(const BorderMates& mates) {
  const int n = mates.size();
  Grid<Diagonal> diagonals(n - 1, n - 1);
  for (int r = 0; r + 1 < n; ++r)
    for (int c = 0; c + 1 < n; ++c)
      diagonals(r, c) = mates.has_cell(r, c) ? Diagonal::rising : Diagonal::none;
  return diagonals;
}

/// A sheet of 1 m in charts, placed by a map of the flat one.
struct Charts {
  explicit Charts(const std::vector<Chart>& parts)
      : sheet(whole, parts), grid(sheet.mates.size(), sheet.mates, diagonals_of(sheet.mates)) {}
  template <class Place>
  [[nodiscard]] Planes3 placed(const Place& place) const {
    Planes3 at = testing::flat_sheet(whole);
    for (int s = 0; s < whole * whole; ++s)
      at.set(s, vec_cast<float>(place(vec_cast<double>(at.at(s)))));
    return sheet.cut(at);
  }
  CutSheet sheet;
  SurfaceGrid grid;
};

/// Triangles of a patch, each with the points it has.
struct PatchTriangles {
  std::vector<Corners> corners;
  std::vector<std::array<int, 3>> points;
  void add(const SurfaceGrid& grid, const Planes3& at, int row, int col) {
    constexpr int side = PatchVersions::side;
    for (int r = side * row; r < std::min(side * (row + 1), grid.cells()); ++r)
      for (int c = side * col; c < std::min(side * (col + 1), grid.cells()); ++c)
        for (int half = 0; half < 2 && !grid.missing(r * grid.cells() + c); ++half) {
          const std::array<int, 3> t = grid.triangle(r, c, half);
          corners.push_back({vec_cast<double>(at.at(t[0])), vec_cast<double>(at.at(t[1])),
                             vec_cast<double>(at.at(t[2]))});
          points.push_back({grid.point(t[0]), grid.point(t[1]), grid.point(t[2])});
        }
  }
  /// Crossings of triangles without a common point.
  [[nodiscard]] int crossings() const {
    int count = 0;
    for_self_crossings(corners, {}, [&](int i, int j) {
      const auto shared = [&](int p) {
        return std::find(points[j].begin(), points[j].end(), p) != points[j].end();
      };
      count += std::none_of(points[i].begin(), points[i].end(), shared) ? 1 : 0;
    });
    return count;
  }
};

TEST(UnfoldedBlocks, PatchesThatAreCertainNeverCrossEachOther) {
  int certain = 0, crossing = 0;
  for (const auto& parts : {testing::quarters(whole), testing::pinwheel(whole)}) {
    const Charts charts(parts);
    const int side = Tiling(charts.grid.cells()).patches();
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      Random random(seed);
      const double noise = 0.001 * static_cast<double>(seed), bend = random.uniform(0.5, 12);
      const auto shake = [&] { return noise * random.uniform(-1, 1); };
      const Planes3 at = charts.placed([&](Vec3d p) {
        const double x = p.x + 0.3 * p.z;
        return Vec3d{sine(bend * x) / bend + shake(), (1 - cosine(bend * x)) / bend + shake(),
                     p.z + shake()};
      });
      UnfoldedWindows windows(charts.grid.cells());
      ThreadTeam alone(1);
      windows.find_unfolded({&charts.grid, &at, &at}, 0, alone);
      for (int a = 0; a < side * side; ++a)
        for (int b = a + 1; b < side * side; ++b) {
          const Node first{PatchVersions::level, a / side, a % side},
              second{PatchVersions::level, b / side, b % side};
          const bool unfolded = windows.patches_unfolded_across(first, second);
          if (!unfolded && (a * 31 + b) % 17 != 0) continue;  // some of those that are not
          PatchTriangles both;
          both.add(charts.grid, at, first.row, first.col);
          both.add(charts.grid, at, second.row, second.col);
          const bool crosses = both.crossings() > 0;
          certain += unfolded ? 1 : 0;
          crossing += crosses ? 1 : 0;
          EXPECT_FALSE(unfolded && crosses) << seed << ": patches " << a << " and " << b;
        }
    }
  }
  EXPECT_GT(certain, 900);
  EXPECT_GT(crossing, 50);
}

/// Cells found near each other, in any order.
std::vector<std::pair<int, int>> cells_of(const Charts& charts,
                                          std::span<const CandidateTile> found) {
  const Tiling tiling(charts.grid.cells());
  std::vector<std::pair<int, int>> cells;
  for (const CandidateTile& one : found)
    for_pairs(one, tiling, tiling, [&](const CandidatePair& pair) {
      cells.emplace_back(std::min(pair.a, pair.b), std::max(pair.a, pair.b));
    });
  std::sort(cells.begin(), cells.end());
  return cells;
}

/// Bends a sheet to and fro, and looks whether a search that remembers finds what a new one does.
/// @return how many cells are near each other at most
std::size_t bend_to_and_fro(const Charts& charts, float skin) {
  constexpr float reach = 0.01F;
  const std::array<const SurfaceGrid*, 1> grids{&charts.grid};
  const auto make = [&] {
    return CoherentPairs(std::make_unique<PyramidPairs>(grids, 1), grids, 1, skin);
  };
  ThreadTeam alone(1);
  CoherentPairs pairs = make();
  std::size_t most = 0;
  for (const double bend : {0.1, 3.0, 6.2, 9.0, 6.2, 0.2, 8.0}) {
    const Planes3 at = charts.placed([&](Vec3d p) {
      return Vec3d{sine(bend * p.x) / bend, (1 - cosine(bend * p.x)) / bend + 0.004 * p.x, p.z};
    });
    const MovingSurface surface{&charts.grid, &at, &at};
    CoherentPairs anew = make();
    pairs.refit(std::array{surface}, alone);
    anew.refit(std::array{surface}, alone);
    const auto kept = cells_of(charts, pairs.find_self(0, reach, 0, alone)),
               fresh = cells_of(charts, anew.find_self(0, reach, 0, alone));
    // What is kept may have some within the skin beyond.
    EXPECT_TRUE(std::includes(kept.begin(), kept.end(), fresh.begin(), fresh.end())) << bend;
    most = std::max(most, fresh.size());
  }
  return most;
}

TEST(UnfoldedBlocks, WhatFoldsAtASeamIsFoundAsIfLookedForAnew) {
  for (const auto& parts : {testing::quarters(whole), testing::pinwheel(whole)}) {
    const Charts charts(parts);
    EXPECT_GT(bend_to_and_fro(charts, 0.004F), 100U);
    // Within so wide a skin nothing moves: that a window has folded is all that tells.
    EXPECT_GT(bend_to_and_fro(charts, 4), 100U);
  }
}

}  // namespace
}  // namespace weft
