#include "weft/collide/contacts/body_query.h"

#include <gtest/gtest.h>

#include "tests/collide/test_bodies.h"
#include "weft/core/random.h"
#include "weft/mesh/distance.h"

namespace weft {
namespace {

struct Placed {
  explicit Placed(Body of)
      : body(std::move(of)), grid(body.positions.size(), body.mates, {}), query(grid), team(2) {
    query.place(body.positions, team);
  }
  [[nodiscard]] double brute_distance(Vec3d p) const {
    double min = HUGE_VAL;
    for (int t = 0; t < 2 * grid.cells() * grid.cells(); ++t) {
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

TEST(BodyQuery, ClosestPointIsThatOfAllTriangles) {
  for (const Placed& placed :
       {Placed(test::torus(17, 0.5, 0.2)), Placed(test::octahedral_sphere(18, 0.6, {}))}) {
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
