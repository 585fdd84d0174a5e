#include "weft/collide/pairs/self_clearance.h"

#include <gtest/gtest.h>

#include "tests/collide/test_bodies.h"
#include "weft/collide/guarding_collider.h"

namespace weft {
namespace {

constexpr int n = 33;

Planes3 sheet() {
  Planes3 planes(n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c)
      planes.set(r, c, vec_cast<float>(Vec3d{0.01 * c, 0.02 * sine(0.1 * c), 0.01 * r}));
  return planes;
}

Planes3 moved(const Planes3& from, const std::function<Vec3d(Vec3d)>& motion) {
  Planes3 to(from.size());
  for (int s = 0; s < n * n; ++s) to.set(s, vec_cast<float>(motion(vec_cast<double>(from.at(s)))));
  return to;
}

TEST(SelfClearance, CoversCommonWaysAndSmallChangesOnly) {
  SelfClearance clearance;
  const Planes3 start = sheet();
  EXPECT_FALSE(clearance.covers(start)) << "nothing is known yet";
  clearance.keep(start, {.slack = 0.001F, .room = 0.05F});
  EXPECT_TRUE(clearance.covers(start));
  EXPECT_TRUE(clearance.covers(moved(start, [](Vec3d p) { return p + Vec3d{3, -2, 1}; })));
  // Strained by less than a fifth and by more, along rows, along columns.
  for (const Vec3d along : {Vec3d{1, 0, 0}, Vec3d{0, 0, 1}})
    for (const double strain : {0.18, 0.22})
      EXPECT_EQ(clearance.covers(
                    moved(start, [&](Vec3d p) { return p + (strain * dot(p, along)) * along; })),
                strain < 0.2);
  // Small changes from edge to edge that add up to more than the room.
  const auto sheared = [](double by) {
    return [by](Vec3d p) { return p + Vec3d{0, by * p.x, 0}; };
  };
  EXPECT_TRUE(clearance.covers(moved(start, sheared(0.15))));
  Planes3 one = start;
  one.set(7, 9, one.at(7, 9) + Vec3f{0, 0.0025F, 0});
  EXPECT_FALSE(clearance.covers(one)) << "one sample of all";
  clearance.keep(start, {.slack = 0.1F, .room = 0.02F});
  EXPECT_FALSE(clearance.covers(moved(start, sheared(0.15)))) << "it leaves the room";
  clearance.forget();
  EXPECT_FALSE(clearance.covers(start));
}

/// The collider of one cloth with self-collision and nothing else.
std::unique_ptr<Collider> lonely(const BorderMates& none) {
  GuardedCloth facts{.mates = none, .size = n};
  facts.rest_spacing = 0.01;
  facts.self_collision = true;
  return make_collider(PyramidOptions{}, {}, std::span(&facts, 1));
}

TEST(SelfClearance, AClothThatFoldsWithinAFrameIsStillKeptFromItself) {
  const BorderMates none;
  const std::unique_ptr<Collider> collider = lonely(none);
  ThreadTeam team(1);
  test::TestCloth cloth(n);
  const Planes3 flat = sheet();
  cloth.start = cloth.position = flat;
  collider->begin_frame();
  int self_contacts = 0;
  // Rolled up step by step, a quarter of a turn each, until its ends would pass through each other.
  for (int step = 1; step <= 40; ++step) {
    const double turn = 0.2 * step;
    for (int s = 0; s < n * n; ++s) {
      const Vec3d p = vec_cast<double>(flat.at(s));
      const double angle = turn * p.x / 0.32, radius = 0.32 / turn;
      cloth.position.set(
          s, vec_cast<float>(Vec3d{radius * sine(angle), radius * (1 - cosine(angle)), p.z}));
    }
    const MovingCloth moving = cloth.moving();
    collider->detect(std::span(&moving, 1), 1.0 / 240, team);
    collider->guard(std::span(&moving, 1), 1.0 / 240, team);
    collider->commit();
    self_contacts = std::max(self_contacts, collider->self_contacts());
    cloth.start = cloth.position;
  }
  EXPECT_GT(self_contacts, 0);
  // At more than a turn its end would be inside of where it began.
  const Vec3f end = cloth.position.at(n / 2, n - 1), begin = cloth.position.at(n / 2, 0);
  EXPECT_GT(length(vec_cast<double>(end - begin)), 1e-5);
}

}  // namespace
}  // namespace weft
