#include "weft/collide/contacts/body_query.h"

#include <gtest/gtest.h>

#include "tests/collide/test_bodies.h"
#include "weft/core/random.h"
#include "weft/mesh/distance.h"

namespace weft {
namespace {

struct Placed {
  explicit Placed(Body of, InstructionSet set = best_instruction_set())
      : body(std::move(of)),
        grid(body.positions.size(), body.mates, body.diagonals),
        query(grid),
        team({2, set}) {
    query.place(body.positions, team);
  }
  [[nodiscard]] double brute_distance(Vec3d p) const { return second_distance(p, -1); }
  /// Distance of all triangles but one.
  [[nodiscard]] double second_distance(Vec3d p, int first) const {
    double min = HUGE_VAL;
    for (int t = 0; t < 2 * grid.cells() * grid.cells(); ++t) {
      if (t == first) continue;
      const std::array<int, 3> s = grid.triangle(t / 2, t % 2);
      const auto corner = [&](int k) { return vec_cast<double>(body.positions.at(s[k])); };
      if (!grid.folded(s))
        min = std::min(min, length(p - closest_on_triangle(p, corner(0), corner(1), corner(2))));
    }
    return min;
  }
  Body body;
  SurfaceGrid grid;
  BodyQuery query;
  ThreadTeam team;
};

Vec3d any_point(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

/// A sheet of triangles of all shapes, down to a thousandth as high as they are long, with both
/// kinds of diagonals.
Body needles(int n) {
  Random random(7);
  Body body;
  body.positions = Planes3(n);
  std::vector<double> rows, cols;
  for (int k = 0; k < n; ++k) {
    rows.push_back((rows.empty() ? -0.5 : rows.back()) + std::pow(10, random.uniform(-5, -1)));
    cols.push_back((cols.empty() ? -0.5 : cols.back()) + std::pow(10, random.uniform(-3, -1)));
  }
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c)
      body.positions.set(r, c, vec_cast<float>(Vec3d{rows[r], random.uniform(0, 0.01), cols[c]}));
  body.mates = BorderMates(n, {});
  body.diagonals = Grid<Diagonal>(n - 1, n - 1);
  for (int r = 0; r + 1 < n; ++r)
    for (int c = 0; c + 1 < n; ++c)
      body.diagonals(r, c) = random.index(2) == 0 ? Diagonal::rising : Diagonal::falling;
  return body;
}

/// Leaves some cells out.
Body holed(Body body) {
  const int cells = body.positions.size() - 1;
  body.diagonals = Grid<Diagonal>(cells, cells, Diagonal::rising);
  for (int r = 3; r < 7; ++r)
    for (int c = 2; c < 9; ++c) body.diagonals(r, c) = Diagonal::none;
  return body;
}

TEST(BodyQuery, ClosestPointIsThatOfAllTriangles) {
  const Body bodies[] = {test::torus(17, 0.5, 0.2), test::octahedral_sphere(18, 0.6, {}),
                         needles(20), holed(test::torus(12, 0.5, 0.2))};
  for (const Body& body : bodies) {
    const Placed placed(body);
    Random random(1);
    for (int i = 0; i < 300; ++i) {
      const Vec3d p = any_point(random, 0.9);
      const auto found = placed.query.closest(p, HUGE_VAL);
      ASSERT_TRUE(found.has_value());
      EXPECT_NEAR(std::sqrt(found->squared_distance), placed.brute_distance(p), 1e-12);
      EXPECT_FALSE(placed.query.closest(p, 0.999 * std::sqrt(found->squared_distance)));
    }
  }
}

TEST(BodyQuery, OfVeryManyTrianglesThatAreAboutAsFarTheClosestIsFound) {
  const Placed placed(test::octahedral_sphere(65, 0.6, {}));
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    const Vec3d p = any_point(random, std::pow(10, random.uniform(-7, -1)));
    const auto found = placed.query.closest(p, HUGE_VAL);
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(std::sqrt(found->squared_distance), placed.brute_distance(p), 1e-12);
  }
}

TEST(BodyQuery, HintsChangeNothing) {
  const Placed placed(test::octahedral_sphere(17, 0.6, {}));
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    // Corners of the surface pushed outwards are as close to all triangles around them.
    const int sample = random.index(17 * 17);
    const Vec3d p = 1.2 * vec_cast<double>(placed.body.positions.at(sample));
    const auto plain = placed.query.closest(p, HUGE_VAL);
    for (const int hint : {0, random.index(512), plain->triangle}) {
      const auto hinted = placed.query.closest(p, HUGE_VAL, hint);
      EXPECT_EQ(hinted->triangle, plain->triangle);
      EXPECT_EQ(hinted->position, plain->position);
    }
  }
}

/// Points near a body and far from it, those of a tile next to each other.
NearestTile any_tile(const Placed& placed, Random& random) {
  NearestTile tile;
  const int n = placed.grid.size();
  const Vec3d shift = any_point(random, random.index(3) == 0 ? 0.3 : 0.01);
  const int row = random.index(n), col = random.index(n), count = 1 + random.index(64);
  for (int k = 0; k < count; ++k) {
    const Vec3d at =
        vec_cast<double>(placed.body.positions.at((row + k / 8) % n, (col + k % 8) % n));
    const double reach = random.index(4) == 0 ? 1e9 : random.uniform(0, 0.1);
    tile.add(vec_cast<float>(at + shift), reach, random.index(2 * (n - 1) * (n - 1) + 1) - 1);
  }
  return tile;
}

TEST(BodyQuery, TilesFindWhatPointsFind) {
  const Body bodies[] = {test::torus(33, 0.5, 0.2), test::octahedral_sphere(34, 0.6, {}),
                         needles(40)};
  for (const Body& body : bodies)
    for (const InstructionSet set : instruction_sets()) {
      if (!has_instruction_set(set)) continue;
      const Placed placed(body, set);
      Random random(4);
      int found_any = 0;
      for (int i = 0; i < 60; ++i) {
        NearestTile tile = any_tile(placed, random);
        tile.beyond = random.index(2) == 0 ? 0 : 0.01;
        NearestPoints found;
        placed.query.closest(tile, found);
        for (int k = 0; k < tile.count; ++k) {
          const Vec3d at = vec_cast<double>(tile.at[k]);
          const auto one = placed.query.closest(at, tile.reach[k]);
          ASSERT_EQ(found[k].point.triangle, one ? one->triangle : -1);
          if (!one) continue;
          EXPECT_EQ(found[k].point.position, one->position);
          EXPECT_EQ(found[k].point.squared_distance, one->squared_distance);
          EXPECT_LE(found[k].others, placed.second_distance(at, one->triangle) * (1 + 1e-12));
          ++found_any;
        }
      }
      EXPECT_GT(found_any, 300);
    }
}

TEST(BodyQuery, TheMiddleOfABallIsNearAllOfIt) {
  // More triangles than a search keeps in mind, all within rounding of the same distance.
  const Placed placed(test::octahedral_sphere(65, 0.6, {}));
  const auto found = placed.query.closest({}, HUGE_VAL);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(std::sqrt(found->squared_distance), placed.brute_distance({}), 1e-12);
}

TEST(BodyQuery, TellsInsideFromOutside) {
  const Placed placed(test::torus(33, 0.5, 0.2));
  EXPECT_TRUE(placed.query.closed());
  Random random(3);
  int inside = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3d p = any_point(random, 0.75);
    const double ring = std::sqrt(p.x * p.x + p.z * p.z) - 0.5;
    const double depth = 0.2 - std::sqrt(ring * ring + p.y * p.y);
    if (std::abs(depth) < 0.01) continue;  // facets lie inside the torus
    const auto found = placed.query.closest(p, HUGE_VAL);
    EXPECT_EQ(placed.query.behind(p, *found), depth > 0);
    inside += depth > 0 ? 1 : 0;
  }
  EXPECT_GT(inside, 30);
}

TEST(BodyQuery, ASheetIsNotClosed) {
  Body sheet;
  sheet.positions = Planes3(5);
  for (int s = 0; s < 25; ++s) sheet.positions.set(s, {0.1F * (s % 5), 0, 0.1F * (s / 5)});
  sheet.mates = BorderMates(5, {});
  EXPECT_FALSE(Placed(sheet).query.closed());
}

}  // namespace
}  // namespace weft
