#include "weft/sim/stepping/adaptive_substeps.h"

#include <gtest/gtest.h>

#include "tests/collide/test_bodies.h"

namespace weft {
namespace {

constexpr int body_size = 17;
constexpr double max_way = 0.004;

template <class Motion>
Planes3 moved(const Planes3& from, const Motion& motion) {
  Planes3 to(from.size());
  for (int s = 0; s < from.size() * from.size(); ++s)
    to.set(s, vec_cast<float>(motion(vec_cast<double>(from.at(s)))));
  return to;
}

Vec3d about_y(Vec3d p, double angle) {
  return {cosine(angle) * p.x + sine(angle) * p.z, p.y, cosine(angle) * p.z - sine(angle) * p.x};
}
Vec3d about_x(Vec3d p, double angle) {
  return {p.x, cosine(angle) * p.y - sine(angle) * p.z, sine(angle) * p.y + cosine(angle) * p.z};
}

TEST(AdaptiveSubsteps, TheFarthestOfAllWaysIsFound) {
  Planes3 from(2);
  for (int s = 0; s < 4; ++s) from.set(s, {1, 2, 3});
  Planes3 to = from;
  EXPECT_EQ(largest_displacement(from, to), 0);
  to.set(1, {1, 5, -1});
  EXPECT_EQ(largest_displacement(from, to), 5);
}

/// A flat sheet that stands still.
ClothReach sheet_at(Vec3d middle, double half = 0.5) {
  constexpr int n = 33;
  ClothState cloth{Planes3(n), Planes3(n)};
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c)
      cloth.position.set(r, c,
                         vec_cast<float>(middle + Vec3d{half * (2.0 * c / (n - 1) - 1), 0,
                                                        half * (2.0 * r / (n - 1) - 1)}));
  ClothReach reach(n);
  reach.place(cloth, 0.01, 0.01);
  return reach;
}

/// Of a body with the image of a sphere.
double pieces_of(const Planes3& start, const Planes3& end, const ClothReach& cloth) {
  const BorderMates mates = test::octahedral_sphere(start.size(), 1, {}).mates;
  const SurfaceGrid grid(start.size(), mates, {});
  ThreadTeam team(2);
  SurfaceMotion surface(grid);
  surface.measure(start, end, team);
  BlockMotion motion;
  motion.measure(grid, start, end, &surface, team);
  // Slow: a second long.
  return wanted_subdivisions(motion, cloth, {max_way / ApproachRule::max_gaps, 1});
}

TEST(AdaptiveSubsteps, ArePowersOfTwo) {
  EXPECT_EQ(whole_subdivisions(1), 1);
  EXPECT_EQ(whole_subdivisions(1.01), 2);
  EXPECT_EQ(whole_subdivisions(4.1), 8);
  EXPECT_EQ(whole_subdivisions(1e9), max_subdivisions);
}

TEST(AdaptiveSubsteps, TheFasterABodyTheShorterItsWayInAStep) {
  constexpr double gap = 0.001, seconds = 0.01;
  const ApproachRule rule{gap, seconds};
  const auto way_at = [&](double speed) { return speed * seconds / rule.parts(speed * seconds); };
  EXPECT_EQ(rule.parts(0), 0);
  for (const double slow : {0.1, 1.0, 3.0}) EXPECT_NEAR(way_at(slow), 3 * gap, 1e-12);
  EXPECT_NEAR(way_at(6), 1.5 * gap, 1e-12);
  for (const double fast : {12.0, 100.0}) EXPECT_NEAR(way_at(fast), 0.75 * gap, 1e-12);
}

TEST(AdaptiveSubsteps, ABallThatFliesAtClothAsksForItsWhole) {
  const Planes3 ball = test::octahedral_sphere(body_size, 0.5, {0, 0, 0}).positions;
  const auto up = [](Vec3d p) { return p + Vec3d{0, 0.04, 0}; };
  EXPECT_NEAR(pieces_of(ball, moved(ball, up), sheet_at({0, 0.52, 0})), 10, 0.2);
  EXPECT_EQ(pieces_of(ball, moved(ball, up), sheet_at({0, 0.7, 0})), 1) << "far from it";
}

TEST(AdaptiveSubsteps, ABallThatTurnsInPlaceAsksForNone) {
  const Planes3 ball = test::octahedral_sphere(65, 0.5, {0, 0, 0}).positions;
  for (const auto& turn : {about_x, about_y}) {
    const auto turned = [&](Vec3d p) { return turn(p, 0.3); };
    EXPECT_EQ(pieces_of(ball, moved(ball, turned), sheet_at({0, 0.505, 0})), 1);
  }
  const auto far = [](Vec3d p) { return about_x(p, 1.2); };
  EXPECT_GT(pieces_of(ball, moved(ball, far), sheet_at({0, 0.505, 0})), 2) << "turns too far";
}

TEST(AdaptiveSubsteps, ABeamThatTurnsStrikesWithItsSides) {
  Planes3 beam = test::octahedral_sphere(body_size, 1, {0, 0, 0}).positions;
  beam = moved(beam, [](Vec3d p) { return Vec3d{p.x, 0.02 * p.y, 0.02 * p.z}; });
  // About the z axis: its ends go up and down by 0.1.
  const auto turned = [](Vec3d p) {
    return Vec3d{cosine(0.1) * p.x - sine(0.1) * p.y, sine(0.1) * p.x + cosine(0.1) * p.y, p.z};
  };
  const Planes3 end = moved(beam, turned);
  EXPECT_GT(pieces_of(beam, end, sheet_at({0.9, 0.05, 0}, 0.1)), 18);
  EXPECT_LT(pieces_of(beam, end, sheet_at({0.1, 0.03, 0}, 0.05)), 9) << "near the axis";
}

TEST(AdaptiveSubsteps, OnlyBlocksOfClothCount) {
  // A sheet that is bent like a hook: a body in the hook's empty middle is in its box alone.
  constexpr int n = 65;
  ClothState cloth{Planes3(n), Planes3(n)};
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const double angle = pi * c / (n - 1);
      cloth.position.set(r, c, vec_cast<float>(Vec3d{cosine(angle), sine(angle), 0.01 * r}));
    }
  ClothReach reach(n);
  reach.place(cloth, 0.01, 0.01);
  const Planes3 ball = test::octahedral_sphere(body_size, 0.1, {0, 0.2, 0.3}).positions;
  const auto up = [](Vec3d p) { return p + Vec3d{0, 0.04, 0}; };
  EXPECT_EQ(pieces_of(ball, moved(ball, up), reach), 1);
  const auto far_up = [](Vec3d p) { return p + Vec3d{0, 0.7, 0}; };
  EXPECT_GT(pieces_of(ball, moved(ball, far_up), reach), 100);
}

TEST(AdaptiveSubsteps, ReachHoldsWhereClothFlies) {
  ClothState cloth{Planes3(2), Planes3(2)};
  for (int s = 0; s < 4; ++s) {
    cloth.position.set(s, {1, 2, 3});
    cloth.velocity.set(s, {4, 0, -2});
  }
  ClothReach reach(2);
  reach.place(cloth, 0.5, 0.25);
  EXPECT_EQ(reach.whole().lower, (Vec3d{0.75, 1.75, 1.75}));
  EXPECT_EQ(reach.whole().upper, (Vec3d{3.25, 2.25, 3.25}));
}

}  // namespace
}  // namespace weft
