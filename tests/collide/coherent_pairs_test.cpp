#include "weft/collide/broad_phase/coherent_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "weft/collide/broad_phase/pyramid_pairs.h"
#include "weft/core/random.h"

namespace weft::coherent_pairs_test {
namespace {

using Pairs = std::set<std::pair<int, int>>;

constexpr int n = 33;

Pairs set_of(std::span<const CandidateTile> found) {
  Pairs pairs;
  for (const CandidateTile& one : found)
    for_pairs(one, Tiling(n - 1), Tiling(n - 1), [&](const CandidatePair& pair) {
      pairs.insert({pair.a, pair.b});
    });
  return pairs;
}

/// Counts the patches of the first surface that it is asked for.
class Counted final : public BroadPhase {
 public:
  Counted(std::span<const SurfaceGrid* const> grids, std::size_t cloths, int& searches,
          int& patches)
      : pyramid_(grids, cloths), searches_(searches), patches_(patches) {}
  void refit(std::span<const MovingSurface> surfaces, ThreadTeam& team) override {
    pyramid_.refit(surfaces, team);
  }
  void find(int a, int b, float reach, ThreadTeam& team, std::vector<CandidateTile>& out) override {
    pyramid_.find(a, b, reach, team, out);
  }
  void find_self(int a, float reach, float slack, ThreadTeam& team,
                 std::vector<CandidateTile>& out) override {
    pyramid_.find_self(a, reach, slack, team, out);
  }
  bool find_changed(int a, int b, float reach, const ChangedPatches& changed, ThreadTeam& team,
                    std::vector<CandidateTile>& out) override {
    ++searches_;
    for (int p = 0; p < changed.a->patches() * changed.a->patches(); ++p)
      patches_ += changed.a->of(p) > changed.since ? 1 : 0;
    return pyramid_.find_changed(a, b, reach, changed, team, out);
  }

 private:
  PyramidPairs pyramid_;
  int &searches_, &patches_;
};

/// Tells which pairs single precision cannot tell to be farther apart.
class NearCells {
 public:
  NearCells(const MovingSurface& a, const MovingSurface& b) : a_(*a.grid), b_(*b.grid) {
    ThreadTeam alone(1);
    a_.take(a);
    b_.take(b);
    a_.fit(alone);
    b_.fit(alone);
  }
  [[nodiscard]] bool has(const CandidatePair& pair, float reach) const {
    const Tiling& tiling = b_.tiling();
    std::array<float, tile_cells> gaps;
    collide_kernels_for(InstructionSet::baseline)
        .tile_gaps(a_.cell(pair.a / (n - 1), pair.a % (n - 1)),
                   b_.tile(tiling.tile_at(pair.b / (n - 1), pair.b % (n - 1))), reach, reach,
                   gaps.data());
    return !(gaps[Tiling::lane_at(pair.b / (n - 1), pair.b % (n - 1))] > 0);
  }
  /// Those of a list, in its order.
  [[nodiscard]] std::vector<std::pair<int, int>> of(std::span<const CandidateTile> found,
                                                    float reach) const {
    std::vector<std::pair<int, int>> near;
    for (const CandidateTile& one : found)
      for_pairs(one, a_.tiling(), b_.tiling(), [&](const CandidatePair& pair) {
        if (has(pair, reach)) near.emplace_back(pair.a, pair.b);
      });
    return near;
  }

 private:
  CellTiles a_, b_;
};

/// Two wavy sheets above each other, the lower one folded onto itself.
class Sheets {
 public:
  static constexpr float skin = 0.004F;
  Sheets()
      : pairs_(std::make_unique<Counted>(grids(), 2, searches, patches), grids(), 2, skin),
        fresh_(grids(), 2) {
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) {
        const float x = 0.03F * static_cast<float>(c), z = 0.03F * static_cast<float>(r);
        const float wave = 0.01F * static_cast<float>((c * 7 + r * 3) % 5);
        upper_.set(r, c, {x, 0.05F + wave, z});
        const bool back = c > n / 2;
        lower_.set(r, c, {back ? 0.96F - x : x, (back ? 0.03F : 0.0F) + wave, z});
      }
    upper_end_ = upper_;
    lower_end_ = lower_;
  }
  void move(float max) {
    for (Planes3* planes : {&upper_, &upper_end_, &lower_, &lower_end_})
      for (int s = 0; s < n * n; ++s) {
        const auto aside = [&] { return max * static_cast<float>(2 * chance_.uniform() - 1); };
        planes->set(s, planes->at(s) + Vec3f{aside(), aside(), aside()});
      }
  }
  void refit() {
    pairs_.refit(surfaces(), team_);
    fresh_.refit(surfaces(), team_);
  }
  /// Whether all that a search finds now, of which single precision cannot tell that it is farther
  /// away, is among what is remembered.
  void check(float reach) {
    const std::array placed = surfaces();
    for (int b = 0; b < 2; ++b) {
      std::vector<CandidateTile> now;
      if (b == 0) {
        fresh_.find_self(0, reach, slack, team_, now);
      } else {
        fresh_.find(0, b, reach, team_, now);
      }
      const Pairs known = set_of(b == 0 ? pairs_.find_self(0, reach, slack, team_)
                                        : pairs_.find(0, b, reach, team_));
      int near = 0;
      const NearCells cells(placed[0], placed[b]);
      for (const auto& [p, q] : set_of(now)) {
        if (!cells.has({p, q}, reach)) continue;
        ++near;
        EXPECT_TRUE(known.count({p, q})) << b << ": " << p << " " << q;
      }
      EXPECT_GT(near, 100);
      // Neighbours that are flat are left out, as a search now does.
      for (int cell = 0; b == 0 && cell < n - 2; ++cell)
        EXPECT_EQ(known.count({cell, cell + 1}), set_of(now).count({cell, cell + 1}));
    }
  }
  /// Moves a corner of the upper sheet.
  void move_corner(float by) {
    for (Planes3* planes : {&upper_, &upper_end_}) planes->set(0, planes->at(0) - Vec3f{0, by, 0});
  }
  /// The pairs that are near now, in their order; and those of a cache that knows nothing yet.
  std::array<std::vector<std::pair<int, int>>, 2> near_in_order(float reach) {
    const std::array placed = surfaces();
    const NearCells cells(placed[0], placed[1]);
    CoherentPairs anew(std::make_unique<PyramidPairs>(grids(), 2), grids(), 2, skin);
    anew.refit(placed, team_);
    return {cells.of(pairs_.find(0, 1, reach, team_), reach),
            cells.of(anew.find(0, 1, reach, team_), reach)};
  }
  int searches = 0, patches = 0;

 private:
  static constexpr float slack = 0.001F;
  std::array<const SurfaceGrid*, 2> grids() { return {&grid_, &grid_}; }
  std::array<MovingSurface, 2> surfaces() {
    return {MovingSurface{&grid_, &lower_, &lower_end_},
            MovingSurface{&grid_, &upper_, &upper_end_}};
  }
  SurfaceGrid grid_{n, BorderMates(), {}};
  Planes3 upper_{n}, upper_end_{n}, lower_{n}, lower_end_{n};
  ThreadTeam team_{2};
  CoherentPairs pairs_;
  PyramidPairs fresh_;
  Random chance_{7};
};

TEST(CoherentPairs, HoldAllThatCameNearSinceTheyWereLookedFor) {
  Sheets sheets;
  for (int step = 0; step < 12; ++step) {
    sheets.refit();
    for (const float reach : {0.03F, 0.01F, 0.02F}) sheets.check(reach);
    sheets.move(0.0003F);
  }
  // Half the skin is spent every few steps.
  EXPECT_GT(sheets.searches, 2);
  EXPECT_LT(sheets.searches, 2 * 12);
}

TEST(CoherentPairs, AreLookedForAnewWhereSurfacesMovedFar) {
  Sheets sheets;
  for (int step = 1; step < 5; ++step) {
    sheets.refit();
    sheets.check(0.03F);
    EXPECT_EQ(sheets.searches, 2 * step);
    EXPECT_EQ(sheets.patches, 2 * step * 8 * 8);
    sheets.move(0.01F);
  }
}

TEST(CoherentPairs, AreLookedForAnewOnlyWhereSurfacesMovedFar) {
  Sheets sheets;
  sheets.refit();
  sheets.check(0.03F);
  for (int step = 1; step < 4; ++step) {
    sheets.move_corner(0.01F);
    sheets.refit();
    sheets.check(0.03F);
    EXPECT_EQ(sheets.searches, 2 + step) << "the lower sheet did not move";
    EXPECT_EQ(sheets.patches, 2 * 8 * 8);
  }
}

TEST(CoherentPairs, AreInAnOrderThatDoesNotDependOnWhenTheyWereFound) {
  Sheets sheets;
  for (int step = 0; step < 12; ++step) {
    if (step % 3 == 0) sheets.move_corner(0.005F);
    sheets.move(0.0006F);
    sheets.refit();
    const auto [known, anew] = sheets.near_in_order(0.02F);
    // What was farther away once may be known to be so still, where a search now cannot tell.
    const Pairs all_known(known.begin(), known.end());
    std::vector<std::pair<int, int>> both;
    std::copy_if(anew.begin(), anew.end(), std::back_inserter(both),
                 [&](const auto& pair) { return all_known.contains(pair); });
    EXPECT_GT(both.size(), anew.size() * 99 / 100);
    EXPECT_EQ(known, both);
  }
}

/// A sheet with a pleat on the left; on the right its samples go to and fro along rows by so much.
Planes3 crimped(float by) {
  Planes3 sheet(n);
  constexpr float spacing = 0.001F;
  constexpr std::array to_and_fro{0.0F, 1.0F, 0.0F, -1.0F};
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const float x = spacing * static_cast<float>(c), pleat = c >= 2 && c < 8 ? 2 * spacing : 0;
      sheet.set(r, c,
                {c < n / 2 ? std::fabs(x - 5 * spacing) : x + by * to_and_fro[c % 4],
                 c < n / 2 && c < 5 ? pleat : 0, spacing * static_cast<float>(r)});
    }
  return sheet;
}

TEST(CoherentPairs, AreLookedForAnewInWindowsThatFold) {
  constexpr float skin = 0.004F, slack = 0.0001F, reach = 0.001F;
  const SurfaceGrid grid(n, BorderMates(), {});
  const std::array<const SurfaceGrid*, 1> grids{&grid};
  ThreadTeam alone(1);
  CoherentPairs pairs(std::make_unique<PyramidPairs>(grids, 1), grids, 1, skin);
  Planes3 now = crimped(0);
  const std::array placed{MovingSurface{&grid, &now, &now}};
  const auto found = [&] {
    pairs.refit(placed, alone);
    return set_of(pairs.find_self(0, reach, slack, alone));
  };
  const auto on_the_right = [](const Pairs& of) {
    return std::count_if(of.begin(), of.end(), [](const auto& pair) {
      return pair.first % (n - 1) > n / 2 &&
             pair.second % (n - 1) - pair.first % (n - 1) > UnfoldedWindows::neighbours;
    });
  };
  const Pairs flat = found();
  EXPECT_FALSE(flat.empty());
  EXPECT_EQ(on_the_right(flat), 0);
  // All move by less than half the skin.
  now = crimped(0.0019F);
  const Pairs known = found();
  pairs.forget();
  const Pairs anew = found();
  EXPECT_GT(on_the_right(anew), n);
  EXPECT_TRUE(std::includes(known.begin(), known.end(), anew.begin(), anew.end()));
}

TEST(CoherentPairs, AskedForMoreAreLookedForAnew) {
  Sheets sheets;
  sheets.refit();
  sheets.check(0.01F);
  sheets.check(0.03F);
  EXPECT_EQ(sheets.searches, 4);
  sheets.check(0.02F);
  EXPECT_EQ(sheets.searches, 4);
}

}  // namespace
}  // namespace weft::coherent_pairs_test
