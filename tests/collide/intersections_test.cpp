#include "weft/collide/intersections.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "tests/collide/test_bodies.h"
#include "weft/core/random.h"

namespace weft {
namespace {

/// A grid with its triangles.
struct Sheet {
  Sheet(int n, const std::function<Vec3d(int, int)>& place) : positions(n) {
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) {
        positions.set(r, c, vec_cast<float>(place(r, c)));
        if (r == 0 || c == 0) continue;
        const int s = r * n + c;
        triangles.push_back({s - n - 1, s - n, s});
        triangles.push_back({s - n - 1, s, s - 1});
      }
  }
  [[nodiscard]] GridTriangles grid() const { return {&positions, &triangles}; }
  [[nodiscard]] std::vector<Corners> corners() const {
    std::vector<Corners> corners;
    const auto at = [&](int s) { return vec_cast<double>(positions.at(s)); };
    for (const auto& [a, b, c] : triangles) corners.push_back({at(a), at(b), at(c)});
    return corners;
  }

  Planes3 positions;
  std::vector<Triangle> triangles;
};

std::int64_t brute_pairs(const Sheet& a, const Sheet& b) {
  std::int64_t count = 0;
  for (const Corners& s : a.corners())
    for (const Corners& t : b.corners()) count += triangles_cross(s, t) ? 1 : 0;
  return count;
}

std::int64_t brute_self(const Sheet& a) {
  std::int64_t count = 0;
  const std::vector<Corners> corners = a.corners();
  for (std::size_t s = 0; s < corners.size(); ++s)
    for (std::size_t t = 0; t < s; ++t) count += triangles_cross(corners[s], corners[t]) ? 1 : 0;
  return count;
}

IntersectionCounts count_once(const Sheet& cloth, std::optional<double> ground = {}) {
  const GridTriangles grid = cloth.grid();
  return IntersectionCheck(std::span(&grid, 1), {}, ground).count();
}

constexpr int size = 21;

Vec3d level(int r, int c) { return {0.1 * c, 0, 0.1 * r}; }

TEST(Intersections, CountsOfEveryKindEqualTestingEveryPair) {
  Random random(7);
  const auto rough = [&](Vec3d p, double amount) {
    const auto noise = [&] { return amount * random.uniform(-1, 1); };
    return p + Vec3d{noise(), noise(), noise()};
  };
  const Sheet first(size, [&](int r, int c) { return rough(level(r, c), 0.12); });
  const Sheet second(size, [&](int r, int c) {
    return rough({0.1 * c + 0.03, 0.1 * r - 1, 1.01}, 0.05);
  });
  const Sheet body(size, [&](int r, int c) { return rough({0.73, 0.1 * c - 1, 0.1 * r}, 0.01); });
  const std::array<GridTriangles, 2> cloths{first.grid(), second.grid()};
  const GridTriangles obstacle = body.grid();
  IntersectionCheck check(cloths, std::span(&obstacle, 1), -0.1);
  const IntersectionCounts counts = check.count();
  EXPECT_GT(counts.self, 100);
  EXPECT_EQ(counts.self, brute_self(first) + brute_self(second));
  EXPECT_GT(counts.cloths, 20);
  EXPECT_EQ(counts.cloths, brute_pairs(first, second));
  EXPECT_GT(counts.bodies, 20);
  EXPECT_EQ(counts.bodies, brute_pairs(first, body) + brute_pairs(second, body));
  std::int64_t below = 0;
  for (const Sheet* sheet : {&first, &second})
    for (const Corners& t : sheet->corners())
      below += t[0].y < -0.1 || t[1].y < -0.1 || t[2].y < -0.1 ? 1 : 0;
  EXPECT_GT(below, 20);
  EXPECT_EQ(counts.ground, below);
  EXPECT_EQ(counts.total(), counts.self + counts.cloths + counts.bodies + counts.ground);
}

TEST(Intersections, FollowWhateverMoves) {
  Sheet cloth(size, level);
  Sheet body(size, [](int r, int c) { return Vec3d{0.1 * c - 0.51, -1 + 0.03 * r, 0.97}; });
  const GridTriangles moving = cloth.grid(), obstacle = body.grid();
  IntersectionCheck check(std::span(&moving, 1), std::span(&obstacle, 1), {});
  EXPECT_EQ(check.count().total(), 0);
  for (int s = 0; s < size * size; ++s)
    body.positions.set(s, body.positions.at(s) + Vec3f{0, 0.8F, 0});
  const std::int64_t through = check.count().bodies;
  EXPECT_EQ(through, brute_pairs(cloth, body));
  EXPECT_GT(through, 10);
  for (int s = 0; s < size * size; ++s)
    cloth.positions.set(s, cloth.positions.at(s) + Vec3f{0, 1, 0});
  EXPECT_EQ(check.count().total(), 0);
  // The half beyond the fold turns over into the other half.
  for (int r = 0; r < size; ++r)
    for (int c = size / 2; c < size; ++c)
      cloth.positions.set(
          r, c, {2.03F - 0.1F * c, 1 - 0.02F * (static_cast<float>(c) - 14.5F), 0.1F * r + 0.013F});
  EXPECT_EQ(check.count().self, brute_self(cloth));
  EXPECT_GT(check.count().self, 10);
}

TEST(Intersections, SheetsThatCrossExactlyAlongRowsAreSeen) {
  const Sheet first(size, level);
  const auto count_with = [&](const std::function<Vec3d(int, int)>& place) {
    const Sheet second(size, place);
    const std::array<GridTriangles, 2> cloths{first.grid(), second.grid()};
    return IntersectionCheck(cloths, {}, {}).count().cloths;
  };
  const auto at = [](int row) { return 0.125 * row - 1.25; };
  EXPECT_EQ(count_with([&](int r, int c) { return Vec3d{0.1 * c, at(r), 1}; }), size - 1);
  EXPECT_EQ(count_with([&](int r, int c) {
              return Vec3d{0.1 * c, 1.25 + at(r), 1};
            }),
            0)
      << "its border stands on a row";
}

TEST(Intersections, FlatFoldedAndTouchingClothHasNone) {
  EXPECT_EQ(count_once(Sheet(size, level), 0.0).total(), 0) << "lying on the ground";
  const Sheet tilted(size, [](int r, int c) {
    return Vec3d{0.1 * c, 0.07 * c - 0.03 * r, 0.1 * r};
  });
  EXPECT_EQ(count_once(tilted).total(), 0);
  const Sheet folded(size, [](int r, int c) {
    return c <= 10 ? level(r, c) : Vec3d{0.1 * (20 - c), 1e-6 * (c - 10), 0.1 * r};
  });
  EXPECT_EQ(count_once(folded).total(), 0) << "a micrometre above itself";
  const Sheet onto_itself(size, [](int r, int c) { return level(r, c <= 10 ? c : 20 - c); });
  EXPECT_GE(count_once(onto_itself).self, 400) << "exactly onto itself: overlaps in one plane";
}

TEST(Intersections, ClosedSurfacesHaveNoneAcrossTheirSeams) {
  for (const Body& body :
       {test::octahedral_sphere(33, 0.4, {0, 0, 0}), test::torus(33, 0.4, 0.1)}) {
    Sheet surface(33, [&](int r, int c) { return vec_cast<double>(body.positions.at(r, c)); });
    EXPECT_EQ(count_once(surface).total(), 0);
  }
}

TEST(IntersectionCheck, LeavesOutTrianglesOfABodyThatLieInIt) {
  const Sheet cloth(size, level), body(size, [](int r, int c) {
    return Vec3d{0.1 * c, 0.1 * (r - 10) + 0.03, 0.98};
  });
  std::vector<char> buried(static_cast<std::size_t>(size) * size, 0);
  const GridTriangles own = cloth.grid();
  GridTriangles other = body.grid();
  const auto count = [&] {
    return IntersectionCheck(std::span(&own, 1), std::span(&other, 1), {}).count().bodies;
  };
  const std::int64_t all = count();
  EXPECT_GT(all, 20);
  other.buried = &buried;
  EXPECT_EQ(count(), all);
  for (int s = 0; s < size * size; ++s) buried[s] = s % size < size / 2 ? 1 : 0;
  EXPECT_LT(count(), all);
  EXPECT_GT(count(), 0);
  std::fill(buried.begin(), buried.end(), 2);
  EXPECT_EQ(count(), 0);
}

}  // namespace
}  // namespace weft
