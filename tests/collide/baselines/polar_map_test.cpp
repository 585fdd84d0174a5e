#include "weft/collide/baselines/polar_map.h"

#include <gtest/gtest.h>

#include "tests/collide/test_bodies.h"
#include "tests/support/random_points.h"
#include "weft/core/random.h"
#include "weft/mesh/distance.h"

namespace weft {
namespace {

using test::octahedral_sphere;
using test::random_point;
using test::TestCloth;

/// Distance to the surface by looking at every triangle.
double brute_distance(const GridSurface& surface, Vec3d point) {
  double min = HUGE_VAL;
  for (const auto& [a, b, c] : surface.triangles())
    min = std::min(
        min, length(point - closest_on_triangle(point, surface.position(a), surface.position(b),
                                                surface.position(c))));
  return min;
}

TEST(GridSurface, FoldedSphereIsClosedAndItsNormalsPointOutwards) {
  const Body body = octahedral_sphere(17, 1, {});
  const GridSurface surface(body.positions, body.mates);
  EXPECT_TRUE(surface.closed());
  for (int t = 0; t < static_cast<int>(surface.triangles().size()); ++t) {
    const Vec3d corner = surface.position(surface.triangles()[t][0]);
    EXPECT_GT(dot(surface.normal_at(t, corner), normalized(corner)), 0.95);
  }
}

TEST(GridSurface, ImageWithoutMatesIsOpen) {
  const Body body = octahedral_sphere(17, 1, {});
  EXPECT_FALSE(GridSurface(body.positions, BorderMates(17, {})).closed());
}

TEST(PolarMap, ParityTellsInsideFromOutsideOnATorus) {
  const PolarMap map(test::torus(65, 0.5, 0.2), {});
  Random random(1);
  int inside = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3d p = random_point(random, 0.75);
    const double out = std::sqrt(p.x * p.x + p.z * p.z) - 0.5;
    const double gap = std::sqrt(out * out + p.y * p.y) - 0.2;
    if (std::abs(gap) < 0.003) continue;  // the facets lie that far from the torus
    EXPECT_EQ(map.inside(p), gap < 0) << p.x << ' ' << p.y << ' ' << p.z;
    inside += gap < 0 ? 1 : 0;
  }
  EXPECT_GT(inside, 1000);
}

TEST(PolarMap, TableLeavesNoGap) {
  // A table much finer than the image: every ray from the centre of a closed body must meet it, and
  // from inside exactly once more than from outside.
  const Body body = octahedral_sphere(9, 1, {0.3, -0.2, 0.1});
  PolarMapOptions fine;
  fine.size = 301;
  const PolarMap map(body, fine);
  Random random(2);
  for (int i = 0; i < 20000; ++i) {
    const Vec3d direction = normalized(random_point(random, 1));
    EXPECT_TRUE(map.inside(Vec3d{0.3, -0.2, 0.1} + 0.5 * direction));
    EXPECT_FALSE(map.inside(Vec3d{0.3, -0.2, 0.1} + 1.01 * direction));
  }
}

TEST(PolarMap, RaysThroughPolesSeamsAndSamplesCountOnce) {
  const int n = 17;
  const Body body = octahedral_sphere(n, 1, {});
  const PolarMap map(body, {});
  for (int s = 0; s < n * n; ++s) {
    const Vec3d p = vec_cast<double>(body.positions.at(s));
    EXPECT_TRUE(map.inside(0.5 * p)) << "sample " << s;
    EXPECT_FALSE(map.inside(1.5 * p)) << "sample " << s;
  }
}

TEST(PolarMap, WalkFindsTheClosestPoint) {
  const Body body = test::torus(33, 0.5, 0.2);
  const PolarMap map(body, {});
  const GridSurface surface(body.positions, body.mates);
  Random random(3);
  int found = 0, exact = 0;
  for (int i = 0; i < 1500; ++i) {
    const Vec3d p = random_point(random, 0.7);
    const auto contact = map.contact(p, p, 0.01);
    if (!contact) continue;
    ++found;
    const double min = brute_distance(surface, p);
    exact += std::abs(std::abs(contact->gap) - min) < 1e-9 ? 1 : 0;
    EXPECT_LT(std::abs(contact->gap), 1.1 * min + 1e-9);
    EXPECT_NEAR(length(contact->normal), 1, 1e-9);
  }
  // A walk from sample to sample may stop beside the closest triangle where cells are long and
  // thin.
  EXPECT_GT(found, 100);
  EXPECT_GT(exact, 0.97 * found);
}

TEST(PolarMap, NothingNearTheSurfaceIsMissed) {
  const Body body = test::torus(65, 0.5, 0.2);
  const PolarMap map(body, {});
  const GridSurface surface(body.positions, body.mates);
  Random random(4);
  int missed_inside = 0, inside = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3d p = random_point(random, 0.7);
    if (!map.inside(p) || brute_distance(surface, p) > 0.05) continue;
    ++inside;
    const auto contact = map.contact(p, p, 0.002);
    missed_inside += contact && contact->gap < 0 ? 0 : 1;
  }
  EXPECT_GT(inside, 50);
  EXPECT_EQ(missed_inside, 0);
}

TEST(PolarMap, PrintedMethodPushesAlongTheRadialHit) {
  PolarMapOptions printed;
  printed.walk = false;
  const PolarMap map(octahedral_sphere(65, 1, {}), printed);
  const auto contact = map.contact({0.9, 0, 0}, {0.9, 0, 0}, 0.01);
  ASSERT_TRUE(contact.has_value());
  EXPECT_NEAR(contact->gap, -0.1, 1e-3);
  EXPECT_NEAR(contact->position.x, 1, 1e-3);
  EXPECT_NEAR(contact->normal.x, 1, 1e-3);
}

TEST(PolarMap, OpenSurfaceOnlyHoldsWhatCrossedItDuringTheStep) {
  const int n = 17;
  Body plate;
  plate.positions = Planes3(n);
  plate.mates = BorderMates(n, {});
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c)
      plate.positions.set(r, c,
                          {static_cast<float>(c) / (n - 1), 0, -static_cast<float>(r) / (n - 1)});
  const PolarMap map(plate, {});
  const Vec3d below{0.4, -0.03, -0.4};
  EXPECT_FALSE(map.contact(below, below, 0.002).has_value());
  const auto crossed = map.contact(below, {0.4, 0.01, -0.4}, 0.002);
  ASSERT_TRUE(crossed.has_value());
  EXPECT_NEAR(crossed->gap, -0.03, 1e-6);
  EXPECT_NEAR(crossed->normal.y, 1, 1e-6);
}

TEST(PolarMap, NoClothVertexUnderASphereAfterThePush) {
  const int n = 33;
  const Body body = octahedral_sphere(65, 0.5, {0, 0.5, 0});
  const PolarMap map(body, {});
  Obstacles obstacles;
  obstacles.bodies.push_back(body);
  const auto collider = test::polar_collider(obstacles, 0.004, 0.3);
  TestCloth cloth(n);
  // Bent through the sphere: most of the sheet lies up to 4 cm under its surface.
  cloth.place([](int r, int c) {
    const Vec3d p{0.9 * c / (n - 1) - 0.45, 0, 0.9 * r / (n - 1) - 0.45};
    return Vec3d{p.x, 0.46 + std::sqrt(std::max(0.0, 0.25 - p.x * p.x - p.z * p.z)), p.z};
  });
  ThreadTeam team(1);
  EXPECT_GT(collider->correct(0, cloth.moving(), {}, 1.0 / 240, team), n * n / 2);
  for (int s = 0; s < n * n; ++s) {
    const Vec3d p = vec_cast<double>(cloth.position.at(s));
    EXPECT_FALSE(map.inside(p));
    const auto contact = map.contact(p, p, 0.004);
    EXPECT_TRUE(!contact || contact->gap > 0.004 - 1e-6);
  }
}

}  // namespace
}  // namespace weft
