#include "weft/collide/broad_phase/coherent_pairs.h"

#include <array>
#include <memory>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "weft/collide/broad_phase/cell_gaps.h"
#include "weft/collide/broad_phase/pyramid_pairs.h"
#include "weft/core/random.h"

namespace weft {
namespace {

using Pairs = std::set<std::pair<int, int>>;

Pairs set_of(std::span<const CandidatePair> cells) {
  Pairs pairs;
  for (const CandidatePair& pair : cells) pairs.insert({pair.a, pair.b});
  return pairs;
}

/// Counts what it is asked for.
class Counted final : public BroadPhase {
 public:
  Counted(std::span<const SurfaceGrid* const> grids, std::size_t cloths, int& searches)
      : pyramid_(grids, cloths), searches_(searches) {}
  void refit(std::span<const MovingSurface> surfaces, ThreadTeam& team) override {
    pyramid_.refit(surfaces, team);
  }
  void find(int a, int b, float reach, ThreadTeam& team, std::vector<CandidatePair>& out) override {
    ++searches_;
    pyramid_.find(a, b, reach, team, out);
  }
  void find_self(int a, float reach, float slack, ThreadTeam& team,
                 std::vector<CandidatePair>& out) override {
    ++searches_;
    pyramid_.find_self(a, reach, slack, team, out);
  }

 private:
  PyramidPairs pyramid_;
  int& searches_;
};

/// Two wavy sheets above each other, the lower one folded onto itself.
class Sheets {
 public:
  static constexpr int n = 33;
  static constexpr float skin = 0.004F;
  Sheets()
      : pairs_(std::make_unique<Counted>(grids(), 2, searches), grids(), 2, skin),
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
      std::vector<CandidatePair> now;
      if (b == 0) {
        fresh_.find_self(0, reach, slack, team_, now);
      } else {
        fresh_.find(0, b, reach, team_, now);
      }
      const Pairs known = set_of(b == 0 ? pairs_.find_self(0, reach, slack, team_)
                                        : pairs_.find(0, b, reach, team_));
      int near = 0;
      for (const CandidatePair& pair : now) {
        if (CellGaps(placed[0], pair.a, placed[b], pair.b).apart(reach, reach)) continue;
        ++near;
        EXPECT_TRUE(known.count({pair.a, pair.b})) << b << ": " << pair.a << " " << pair.b;
      }
      EXPECT_GT(near, 100);
      // Neighbours that are flat are left out, as a search now does.
      for (int cell = 0; b == 0 && cell < n - 2; ++cell)
        EXPECT_EQ(known.count({cell, cell + 1}), set_of(now).count({cell, cell + 1}));
    }
  }
  int searches = 0;

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
  EXPECT_LT(sheets.searches, 12);
}

TEST(CoherentPairs, AreLookedForAnewWhereSurfacesMovedFar) {
  Sheets sheets;
  for (int step = 1; step < 5; ++step) {
    sheets.refit();
    sheets.check(0.03F);
    EXPECT_EQ(sheets.searches, 2 * step);
    sheets.move(0.01F);
  }
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
}  // namespace weft
