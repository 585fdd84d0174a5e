#include "weft/collide/broad_phase/cell_tiles.h"

#include <array>
#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "weft/collide/contacts/closest.h"
#include "weft/core/random.h"

namespace weft {
namespace {

/// A rough sheet in motion, whose diagonals alternate.
struct RoughSheet {
  SurfaceGrid grid;
  Planes3 start, end;

  RoughSheet(int n, Random& random, Vec3d at, double rough)
      : grid(n, BorderMates(), diagonals(n)), start(n), end(n) {
    const auto any = [&](double size) {
      return size * Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    };
    const Vec3d displacement = any(0.01);
    for (int s = 0; s < n * n; ++s) {
      const Vec3d p = at + Vec3d{0.01 * (s % n), 0, 0.01 * (s / n)} + any(rough);
      start.set(s, vec_cast<float>(p));
      end.set(s, vec_cast<float>(p + displacement + any(0.002)));
    }
  }
  static Grid<Diagonal> diagonals(int n) {
    Grid<Diagonal> all(n - 1, n - 1, Diagonal::rising);
    for (int r = 0; r < n - 1; ++r)
      for (int c = 0; c < n - 1; ++c)
        if ((r + 2 * c) % 3 == 0) all(r, c) = Diagonal::falling;
    return all;
  }
  [[nodiscard]] MovingSurface surface() const { return {&grid, &start, &end}; }
  [[nodiscard]] Vec3d at(int sample, double time) const {
    return (1 - time) * vec_cast<double>(start.at(sample)) +
           time * vec_cast<double>(end.at(sample));
  }
  [[nodiscard]] Feature triangle(int cell, int half, double time) const {
    Feature feature;
    const std::array<int, 3> samples = grid.triangle(cell, half);
    for (std::size_t k = 0; k < 3; ++k) feature.corners[k] = at(samples[k], time);
    return feature;
  }
  /// An edge of a cell in the kernels' order.
  [[nodiscard]] Feature edge(int cell, int number, double time) const {
    const std::array<int, 4> s = grid.corners(cell);
    const bool falling = grid.triangle_corners(cell, 0)[2] == 2;
    Feature feature;
    feature.count = 2;
    feature.corners[0] = at(number == 2 && falling ? s[1] : s[0], time);
    feature.corners[1] =
        at(number == 0 ? s[1] : (number == 1 ? s[2] : (falling ? s[2] : s[3])), time);
    return feature;
  }
};

double distance(const RoughSheet& a, int cell_a, const RoughSheet& b, int cell_b, double time) {
  double min = HUGE_VAL;
  for (int i = 0; i < 4; ++i)
    min = std::min(min,
                   closest_points(a.triangle(cell_a, i / 2, time), b.triangle(cell_b, i % 2, time))
                       .squared_distance);
  return std::sqrt(min);
}

/// Two sheets and the tiles of both.
struct Pair {
  RoughSheet a, b;
  CellTiles tiles_a, tiles_b;
  Pair(Random& random, Vec3d at, double height)
      : a(6, random, at, 0.002),
        b(7, random, at + Vec3d{-0.003, height, 0.002}, 0.002),
        tiles_a(a.grid),
        tiles_b(b.grid) {
    ThreadTeam alone(1);
    tiles_a.take(a.surface());
    tiles_b.take(b.surface());
    tiles_a.fit(alone);
    tiles_b.fit(alone);
  }
  /// Calls visit(cell of a, tile of b).
  template <class Visit>
  void for_tiles(const Visit& visit) const {
    for (int cell = 0; cell < 5 * 5; ++cell)
      for (int tile = 0; tile < tiles_b.tiling().count(); ++tile) visit(cell, tile);
  }
  /// Calls visit(lane, cell of b) for the cells of a tile that are there.
  template <class Visit>
  void for_lanes(int tile, const Visit& visit) const {
    const Tiling& tiling = tiles_b.tiling();
    for (int lane = 0; lane < tile_cells; ++lane)
      if (tiling.first_row(tile) + lane / Tiling::cols < 6 &&
          tiling.first_col(tile) + lane % Tiling::cols < 6)
        visit(lane, tiling.cell_at(tiling.first_row(tile) + lane / Tiling::cols,
                                   tiling.first_col(tile) + lane % Tiling::cols));
  }
};

const CollideKernels& baseline() { return collide_kernels_for(InstructionSet::baseline); }

TEST(Tiling, EveryCellHasAPlaceInOneTile) {
  for (const int cells : {1, 3, 4, 7, 16}) {
    const Tiling tiling(cells);
    std::set<std::pair<int, int>> places;
    for (int r = 0; r < cells; ++r)
      for (int c = 0; c < cells; ++c) {
        const int tile = tiling.tile_at(r, c), lane = Tiling::lane_at(r, c);
        const int row = tiling.first_row(tile), col = tiling.first_col(tile);
        EXPECT_EQ(row + lane / Tiling::cols, r);
        EXPECT_EQ(col + lane % Tiling::cols, c);
        EXPECT_LT(tile, tiling.count());
        EXPECT_EQ(tiling.patch_at(r, c), tiling.patch_at(row, col));
        places.insert({tile, lane});
      }
    EXPECT_EQ(places.size(), static_cast<std::size_t>(cells * cells));
  }
}

TEST(Tiling, PlacesInOrderGoDownAPyramid) {
  std::vector<unsigned> places;
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) places.push_back(place_in_order(r, c));
  EXPECT_EQ(places, (std::vector<unsigned>{0, 1, 4, 5, 2, 3, 6, 7, 8, 9, 12, 13, 10, 11, 14, 15}));
}

TEST(Tiling, PairsThatAreJoinedToTilesComeOutOnce) {
  Random random(4);
  const Tiling a(9), b(13);
  std::set<std::pair<int, int>> given, found;
  for (int i = 0; i < 300; ++i)
    given.insert(
        {static_cast<int>(random.uniform(0, 81)), static_cast<int>(random.uniform(0, 169))});
  std::vector<CandidatePair> pairs;
  for (const auto& [p, q] : given) pairs.push_back({p, q});
  std::vector<CandidateTile> tiles;
  join_to_tiles(a, b, pairs, tiles);
  for (const CandidateTile& one : tiles)
    for_pairs(one, a, b, [&](const CandidatePair& pair) {
      EXPECT_EQ(b.tile_b(one), b.tile_at(pair.b / 13, pair.b % 13));
      EXPECT_TRUE(found.insert({pair.a, pair.b}).second);
    });
  EXPECT_EQ(found, given);
  EXPECT_LT(tiles.size(), given.size());
}

/// Near the origin and where single precision is coarse.
TEST(TileGaps, WhatIsApartKeepsItsGapsAtBothEndsAndNeverMeets) {
  Random random(7);
  for (const double far : {0.0, 300.0}) {
    int apart = 0, all = 0;
    for (int round = 0; round < 12; ++round) {
      const Pair pair(random, {far, -far, far}, random.uniform(0, 0.02));
      const auto at_start = static_cast<float>(random.uniform(0, 0.004)),
                 at_end = static_cast<float>(random.uniform(0, 0.004));
      pair.for_tiles([&](int cell, int tile) {
        std::array<float, tile_cells> gaps;
        baseline().tile_gaps(pair.tiles_a.cell(cell / 5, cell % 5), pair.tiles_b.tile(tile),
                             at_start, at_end, gaps.data());
        pair.for_lanes(tile, [&](int lane, int other) {
          ++all;
          if (!(gaps[lane] > 0)) return;
          ++apart;
          EXPECT_GT(distance(pair.a, cell, pair.b, other, 0), at_start + 0.999 * gaps[lane]);
          EXPECT_GT(distance(pair.a, cell, pair.b, other, 1), at_end + 0.999 * gaps[lane]);
          for (const double time : {0.25, 0.5, 0.75})
            EXPECT_GT(distance(pair.a, cell, pair.b, other, time), 0);
        });
      });
    }
    EXPECT_GT(apart, all / 2);
  }
}

TEST(TileGaps, LanesWithoutACellAreNeverNear) {
  Random random(2);
  const Pair pair(random, {}, 0);
  pair.for_tiles([&](int cell, int tile) {
    std::array<float, tile_cells> gaps;
    baseline().tile_gaps(pair.tiles_a.cell(cell / 5, cell % 5), pair.tiles_b.tile(tile), 0, 0,
                         gaps.data());
    std::set<int> there;
    pair.for_lanes(tile, [&](int lane, int /*other*/) { there.insert(lane); });
    for (int lane = 0; lane < tile_cells; ++lane)
      EXPECT_EQ(std::isnan(gaps[lane]), !there.contains(lane));
  });
}

/// What the kernels have to find, by exact closest points, and how much they find.
class TileFeatures : public testing::Test {
 protected:
  static constexpr float reach = 0.004F, beside = 0.003F;
  struct Count {
    int touching = 0, found = 0, all = 0;
    void check() const {
      EXPECT_GT(touching, 50);
      EXPECT_LT(found, all / 4) << "and not merely everything";
    }
  };
  static bool inner(const std::array<double, 3>& weights, int count) {
    for (int k = 0; k < count; ++k)
      if (!(weights[k] > 0)) return false;
    return true;
  }
  static Vec3d foot_on_plane(Vec3d point, const Feature& triangle) {
    const auto& [a, b, c] = triangle.corners;
    const Vec3d normal = cross(b - a, c - a);
    return point - dot(normal, point - a) / squared_length(normal) * normal;
  }
  static double distance(Vec3d point, const Feature& triangle) {
    const std::array<double, 3> w = closest_weights(point, triangle.corners);
    return length(point - (w[0] * triangle.corners[0] + w[1] * triangle.corners[1] +
                           w[2] * triangle.corners[2]));
  }
  /// Calls visit(pair, cell, tile, near, near of edges).
  template <class Visit>
  void for_rounds(const Visit& visit) {
    Random random(5);
    for (int round = 0; round < 10; ++round) {
      const Pair pair(random, {}, random.uniform(0, 0.008));
      pair.for_tiles([&](int cell, int tile) {
        std::array<float, tile_cells> near, near_edges;
        baseline().tile_reaches(pair.tiles_a.cell(cell / 5, cell % 5), pair.tiles_b.tile(tile),
                                reach, 0.5F * reach, near.data(), near_edges.data());
        visit(pair, cell, tile, near, near_edges);
      });
    }
  }
};

TEST_F(TileFeatures, WhatIsNearAtTheEndIsWithinTheReachAtTheStart) {
  int near_at_end = 0;
  for_rounds([&](const Pair& pair, int cell, int tile, const auto& near, const auto& edges) {
    pair.for_lanes(tile, [&](int lane, int other) {
      EXPECT_LE(edges[lane], near[lane]);
      for (int i = 0; i < 4; ++i) {
        const ClosestPair closest =
            closest_points(pair.a.triangle(cell, i / 2, 0), pair.b.triangle(other, i % 2, 0));
        const ClosestPair later =
            closest_points(pair.a.triangle(cell, i / 2, 1), pair.b.triangle(other, i % 2, 1));
        if (later.squared_distance > reach * reach) continue;
        ++near_at_end;
        EXPECT_LE(std::sqrt(closest.squared_distance), near[lane]);
      }
    });
  });
  EXPECT_GT(near_at_end, 100);
}

TEST_F(TileFeatures, CornersOverTrianglesAreFoundBothWays) {
  Count count;
  for_rounds([&](const Pair& pair, int cell, int tile, const auto& near, const auto& /*edges*/) {
    const CellCorners own = pair.tiles_a.cell(cell / 5, cell % 5);
    for (int corner = 0; corner < 4; ++corner) {
      std::array<int, tile_cells> over_tile, over_cell;
      baseline().corner_over_tile(own, corner, pair.tiles_b.tile(tile), near.data(), beside,
                                  over_tile.data());
      baseline().tile_over_cell(own, pair.tiles_b.tile(tile), corner, near.data(), beside,
                                over_cell.data());
      const auto check = [&](const RoughSheet& of_point, int point_cell,
                             const RoughSheet& of_triangle, int triangle_cell, int found,
                             float within) {
        const Vec3d point = of_point.at(of_point.grid.corners(point_cell)[corner], 0);
        for (int half = 0; half < 2; ++half) {
          const Feature triangle = of_triangle.triangle(triangle_cell, half, 0);
          const Vec3d foot = foot_on_plane(point, triangle);
          const bool touches = length(point - foot) < within && distance(foot, triangle) < beside;
          const bool is_found = (found >> half & 1) != 0;
          count.touching += touches ? 1 : 0;
          count.found += is_found ? 1 : 0;
          ++count.all;
          EXPECT_TRUE(is_found || !touches);
        }
      };
      pair.for_lanes(tile, [&](int lane, int other) {
        check(pair.a, cell, pair.b, other, over_tile[lane], near[lane]);
        check(pair.b, other, pair.a, cell, over_cell[lane], near[lane]);
      });
    }
  });
  count.check();
}

TEST_F(TileFeatures, EdgesThatCrossAreFound) {
  Count count;
  for_rounds([&](const Pair& pair, int cell, int tile, const auto& near, const auto& /*edges*/) {
    std::array<int, tile_cells> crossing;
    baseline().tile_edges(pair.tiles_a.cell(cell / 5, cell % 5), pair.tiles_b.tile(tile),
                          near.data(), crossing.data());
    pair.for_lanes(tile, [&](int lane, int other) {
      for (int p = 0; p < 3; ++p)
        for (int q = 0; q < 3; ++q) {
          const ClosestPair closest =
              closest_points(pair.a.edge(cell, p, 0), pair.b.edge(other, q, 0));
          const bool touches = inner(closest.weights_a, 2) && inner(closest.weights_b, 2) &&
                               std::sqrt(closest.squared_distance) < near[lane];
          const bool found = (crossing[lane] >> (3 * p + q) & 1) != 0;
          count.touching += touches ? 1 : 0;
          count.found += found ? 1 : 0;
          ++count.all;
          EXPECT_TRUE(found || !touches);
        }
    });
  });
  count.check();
}

TEST_F(TileFeatures, AreTheSameByEveryInstructionSet) {
  for (const InstructionSet set : instruction_sets()) {
    if (!has_instruction_set(set)) continue;
    const CollideKernels& kernels = collide_kernels_for(set);
    for_rounds([&](const Pair& pair, int cell, int tile, const auto& near, const auto& edges) {
      const CellCorners own = pair.tiles_a.cell(cell / 5, cell % 5);
      const TileCorners& other = pair.tiles_b.tile(tile);
      std::array<float, tile_cells> gaps[2], reaches[2];
      std::array<int, tile_cells> over_tile[2], over_cell[2], crossing[2];
      for (int i = 0; i < 2; ++i) {
        const CollideKernels& by = i == 0 ? baseline() : kernels;
        by.tile_gaps(own, other, 0.001F, 0.002F, gaps[i].data());
        by.corner_over_tile(own, 2, other, near.data(), beside, over_tile[i].data());
        by.tile_over_cell(own, other, 1, near.data(), beside, over_cell[i].data());
        by.tile_edges(own, other, edges.data(), crossing[i].data());
      }
      kernels.tile_reaches(own, other, reach, 0.5F * reach, reaches[0].data(), reaches[1].data());
      pair.for_lanes(tile, [&](int lane, int /*other*/) {
        EXPECT_EQ(gaps[0][lane], gaps[1][lane]) << name_of(set);
        EXPECT_EQ(over_tile[0][lane], over_tile[1][lane]) << name_of(set);
        EXPECT_EQ(over_cell[0][lane], over_cell[1][lane]) << name_of(set);
        EXPECT_EQ(crossing[0][lane], crossing[1][lane]) << name_of(set);
        EXPECT_EQ(reaches[0][lane], near[lane]) << name_of(set);
        EXPECT_EQ(reaches[1][lane], edges[lane]) << name_of(set);
      });
    });
  }
}

}  // namespace
}  // namespace weft
