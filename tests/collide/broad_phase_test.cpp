#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "tests/collide/test_bodies.h"
#include "weft/collide/baselines/image_space_pairs.h"
#include "weft/collide/baselines/spatial_hash.h"
#include "weft/collide/baselines/sphere_tree.h"
#include "weft/collide/broad_phase/cell_tiles.h"
#include "weft/collide/broad_phase/pyramid_pairs.h"
#include "weft/core/random.h"
#include "weft/mesh/crossings.h"
#include "weft/mesh/distance.h"

namespace weft {
namespace {

using Grids = std::span<const SurfaceGrid* const>;

std::unique_ptr<BroadPhase> make(const std::string& name, Grids grids, std::size_t cloths) {
  if (name == "pyramid") return std::make_unique<PyramidPairs>(grids, cloths);
  if (name == "sphere_tree") return std::make_unique<SphereTreePairs>(grids, cloths);
  if (name == "spatial_hash") return std::make_unique<SpatialHashPairs>(grids, cloths);
  return std::make_unique<ImageSpacePairs>(grids, cloths);
}

/// A surface without seams that moves.
struct Moving {
  explicit Moving(int n) : grid(n, BorderMates(), {}), start(n), end(n) {}
  void place(const std::function<Vec3d(int, int)>& at) {
    for (int r = 0; r < grid.size(); ++r)
      for (int c = 0; c < grid.size(); ++c) start.set(r, c, vec_cast<float>(at(r, c)));
    end = start;
  }
  void move(const std::function<Vec3d(Vec3d)>& to) {
    for (int s = 0; s < grid.size() * grid.size(); ++s)
      end.set(s, vec_cast<float>(to(vec_cast<double>(start.at(s)))));
  }
  [[nodiscard]] MovingSurface surface() const { return {&grid, &start, &end}; }
  [[nodiscard]] Corners triangle(int cell, int half, double time) const {
    Corners corners;
    const std::array<int, 3> samples = grid.triangle(cell, half);
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = (1 - time) * vec_cast<double>(start.at(samples[k])) +
                   time * vec_cast<double>(end.at(samples[k]));
    return corners;
  }
  [[nodiscard]] Box3d box(int cell) const {
    Box3d box;
    for (const int s : grid.corners(cell)) {
      box.add(vec_cast<double>(start.at(s)));
      box.add(vec_cast<double>(end.at(s)));
    }
    return box;
  }

  SurfaceGrid grid;
  Planes3 start, end;
};

constexpr double steps = 8;

/// Whether two triangles come nearer than `reach`, as far as points of the one tell.
bool come_near(const Corners& a, const Corners& b, double reach) {
  if (triangles_cross(a, b)) return true;
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; i + j <= 4; ++j) {
      const Vec3d p = 0.25 * ((1.0 * i) * a[0] + (1.0 * j) * a[1] + (4.0 - i - j) * a[2]);
      if (length(p - closest_on_triangle(p, b[0], b[1], b[2])) < reach) return true;
    }
  return false;
}

bool cells_come_near(const Moving& a, int cell_a, const Moving& b, int cell_b, double reach) {
  const Box3d box_a = a.box(cell_a), box_b = b.box(cell_b);
  const Vec3d apart = max(box_a.lower - box_b.upper, box_b.lower - box_a.upper);
  if (std::max({apart.x, apart.y, apart.z}) > reach) return false;
  for (double step = 0; step <= steps; ++step)
    for (int half = 0; half < 4; ++half)
      if (come_near(a.triangle(cell_a, half / 2, step / steps),
                    b.triangle(cell_b, half % 2, step / steps), reach))
        return true;
  return false;
}

/// @param cells  a side of both surfaces; of a cloth with itself pairs are put in order
std::set<std::pair<int, int>> as_set(const std::vector<CandidateTile>& found,
                                     std::array<int, 2> cells, bool same = false) {
  std::set<std::pair<int, int>> set;
  std::size_t count = 0;
  for (const CandidateTile& one : found)
    for_pairs(one, Tiling(cells[0]), Tiling(cells[1]), [&](const CandidatePair& pair) {
      ++count;
      const bool swap = same && pair.b < pair.a;
      set.insert({swap ? pair.b : pair.a, swap ? pair.a : pair.b});
    });
  EXPECT_EQ(set.size(), count) << "each pair once";
  return set;
}

class BroadPhases : public testing::TestWithParam<const char*> {
 protected:
  /// What is found by teams of every size and instruction set, which must be the same.
  template <class Find>
  std::vector<CandidateTile> found_by_any_team(const std::vector<MovingSurface>& surfaces,
                                               std::size_t cloths, const Find& find) {
    std::vector<const SurfaceGrid*> grids;
    for (const MovingSurface& surface : surfaces) grids.push_back(surface.grid);
    std::vector<CandidateTile> first;
    std::vector<TeamOptions> teams{1, 2, 3, 7};
    for (const InstructionSet set : instruction_sets())
      if (has_instruction_set(set)) teams.emplace_back(2, set);
    for (const TeamOptions& options : teams) {
      ThreadTeam team(options);
      const std::unique_ptr<BroadPhase> phase = make(GetParam(), grids, cloths);
      std::vector<CandidateTile> pairs;
      for (int again = 0; again < 2; ++again) {
        pairs.clear();
        phase->refit(surfaces, team);
        find(*phase, team, pairs);
        if (first.empty()) first = pairs;
        EXPECT_TRUE(pairs == first)
            << options.size << " threads, " << name_of(options.instructions) << ", fit " << again;
      }
    }
    return first;
  }
};

TEST_P(BroadPhases, FindAllCellsOfTwoSurfacesThatComeNear) {
  Random random(9);
  Moving cloth(18), body(23);
  for (int turn = 0; turn < 4; ++turn) {
    const double speed = 0.1 * turn, reach = 0.01 + 0.02 * turn;
    const auto noise = [&](double amount) {
      return Vec3d{random.uniform(-amount, amount), random.uniform(-amount, amount),
                   random.uniform(-amount, amount)};
    };
    cloth.place([&](int r, int c) { return Vec3d{0.05 * c, 0.4, 0.05 * r} + noise(0.01); });
    cloth.move([&](Vec3d p) { return p + Vec3d{0, -speed, 0} + noise(0.1 * speed); });
    body.place([&](int r, int c) {
      return Vec3d{0.1 * c - 0.8, 0.39 - 0.02 * (c % 7) - 0.01 * turn, 0.06 * r} + noise(0.004);
    });
    if (turn > 1) body.move([&](Vec3d p) { return p + Vec3d{0.05, 0.02 * p.x, 0}; });
    const auto pairs = found_by_any_team({cloth.surface(), body.surface()}, 1,
                                         [&](BroadPhase& phase, ThreadTeam& team, auto& out) {
                                           phase.find(0, 1, static_cast<float>(reach), team, out);
                                         });
    const auto found = as_set(pairs, {17, 22});
    int near = 0;
    for (int a = 0; a < 17 * 17; ++a)
      for (int b = 0; b < 22 * 22; ++b)
        if (cells_come_near(cloth, a, body, b, reach)) {
          ++near;
          EXPECT_TRUE(found.contains({a, b})) << turn << ": " << a << " " << b;
        }
    EXPECT_GT(near, 20);
    EXPECT_LT(found.size(), 17U * 17 * 22 * 22 / 4) << "and not merely everything";
  }
}

TEST_P(BroadPhases, FindAllFarCellsOfAClothThatComeNearEachOther) {
  Random random(3);
  const int n = 22, cells = n - 1;
  const double reach = 0.02;
  Moving cloth(n);
  // Rolled up one and a half times, the layers 3 cm apart, while it falls and is crushed.
  cloth.place([&](int r, int c) {
    const double angle = 3 * pi * c / (n - 1), radius = 0.08 + 0.015 * angle / pi;
    return Vec3d{radius * cosine(angle), radius * sine(angle), 0.03 * r} +
           Vec3d{random.uniform(-0.002, 0.002), random.uniform(-0.002, 0.002), 0};
  });
  cloth.move([](Vec3d p) { return Vec3d{p.x, 0.3 * p.y - 0.2, p.z}; });
  const auto pairs =
      found_by_any_team({cloth.surface()}, 1, [&](BroadPhase& phase, ThreadTeam& team, auto& out) {
        phase.find_self(0, static_cast<float>(reach), 0.001F, team, out);
      });
  const auto found = as_set(pairs, {cells, cells}, true);
  int near = 0;
  for (int a = 0; a < cells * cells; ++a)
    for (int b = a + 1; b < cells * cells; ++b) {
      const bool neighbours =
          std::abs(a / cells - b / cells) <= 2 && std::abs(a % cells - b % cells) <= 2;
      if (neighbours || !cells_come_near(cloth, a, cloth, b, reach)) continue;
      ++near;
      EXPECT_TRUE(found.contains({a, b})) << a << " " << b;
    }
  EXPECT_GT(near, 100);
  for (const auto& [a, b] : found) EXPECT_LT(a, b);
}

TEST_P(BroadPhases, FindNeighboursThatFoldAndLeaveFlatOnesOut) {
  const int n = 14, cells = n - 1;
  Moving flat(n);
  flat.place([](int r, int c) { return Vec3d{0.1 * c, 0.01 * ((r + c) % 3), 0.1 * r}; });
  EXPECT_TRUE(
      found_by_any_team({flat.surface()}, 1, [](BroadPhase& phase, ThreadTeam& team, auto& out) {
        phase.find_self(0, 0.002F, 0.001F, team, out);
      }).empty());
  Random random(8);
  Moving crumpled(n);
  crumpled.place([&](int r, int c) {
    return Vec3d{0.1 * c + random.uniform(-0.13, 0.13), random.uniform(-0.13, 0.13),
                 0.1 * r + random.uniform(-0.13, 0.13)};
  });
  const auto found = as_set(found_by_any_team({crumpled.surface()}, 1,
                                              [](BroadPhase& phase, ThreadTeam& team, auto& out) {
                                                phase.find_self(0, 0.002F, 0.001F, team, out);
                                              }),
                            {cells, cells}, true);
  int crossing = 0;
  for (int a = 0; a < cells * cells; ++a)
    for (int b = a + 1; b < cells * cells; ++b)
      for (int halves = 0; halves < 4; ++halves)
        if (triangles_cross(crumpled.triangle(a, halves / 2, 0),
                            crumpled.triangle(b, halves % 2, 0))) {
          ++crossing;
          EXPECT_TRUE(found.contains({a, b})) << a << " " << b;
        }
  EXPECT_GT(crossing, 50);
}

TEST_P(BroadPhases, AreNotUpsetByFarAndUnfiniteMotion) {
  const int n = 9;
  Moving cloth(n), body(n);
  for (Moving* one : {&cloth, &body})
    one->place([](int r, int c) { return Vec3d{0.1 * c, 0, 0.1 * r}; });
  cloth.move([](Vec3d p) { return p + Vec3d{1e6, 300, -1e9}; });
  cloth.end.set(0, {HUGE_VALF, 0, 0});
  const auto found = as_set(found_by_any_team({cloth.surface(), body.surface()}, 1,
                                              [](BroadPhase& phase, ThreadTeam& team, auto& out) {
                                                phase.find(0, 1, 0.001F, team, out);
                                              }),
                            {n - 1, n - 1});
  EXPECT_TRUE(found.contains({9, 9}));
}

INSTANTIATE_TEST_SUITE_P(Every, BroadPhases,
                         testing::Values("pyramid", "sphere_tree", "spatial_hash", "image_space"),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace
}  // namespace weft
