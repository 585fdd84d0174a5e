#include <algorithm>

#include <gtest/gtest.h>

#include "tests/collide/test_bodies.h"
#include "weft/collide/contacts/block_motion.h"
#include "weft/core/random.h"

namespace weft {
namespace {

using test::octahedral_sphere;

constexpr int cloth_size = 17, obstacle_size = 33;
constexpr double step = 1.0 / 240, radius = 0.25;
constexpr float gap_kept = 0.001F;

/// Where a point goes that flies on and swings to and fro on one side.
Vec3d carried(Vec3d p, double time) {
  const double swing = p.x > 0 ? 0.08 * p.x * std::sin(9 * time) : 0;
  return p + Vec3d{0.2 * time, swing, 0.01 * std::sin(5 * time)};
}

/// A ball that goes so, and shrinks and swells again.
Planes3 ball_at(const Planes3& rest, double time) {
  const double size = 1 - 0.01 * (1 - std::cos(25 * time));
  Planes3 at(rest.size());
  for (int s = 0; s < rest.size() * rest.size(); ++s)
    at.set(s, vec_cast<float>(carried(size * vec_cast<double>(rest.at(s)), time)));
  return at;
}

/// Cloth that hovers over the ball's upper half, some of it near and some far, and trembles.
Planes3 cloth_at(double time, Random& random) {
  Planes3 at(cloth_size);
  for (int r = 0; r < cloth_size; ++r)
    for (int c = 0; c < cloth_size; ++c) {
      const double u = 0.9 * (2.0 * c / (cloth_size - 1) - 1),
                   v = 0.9 * (2.0 * r / (cloth_size - 1) - 1);
      const double away = 0.0003 + 0.0004 * ((7 * r + 11 * c) % 25) + random.uniform(0, 0.0004);
      at.set(r, c, vec_cast<float>(carried((radius + away) * normalized(Vec3d{u, 1, v}), time)));
    }
  return at;
}

CollidingCloth statistics(const BorderMates& mates) {
  return {.mates = mates,
          .size = cloth_size,
          .thickness = gap_kept,
          .rest_spacing = 0.02,
          .self_collision = false,
          .self_thickness = gap_kept};
}

/// A collider and what it looks at, from one step to the next.
struct Watch {
  Watch(const Obstacles& obstacles, const BorderMates& mates)
      : cloth_properties(statistics(mates)),
        collider(make_collider(PyramidOptions{}, obstacles, std::span(&cloth_properties, 1))) {}
  std::vector<Contact> contacts(const Planes3& start, const Planes3& end, const Planes3& body_end) {
    Planes3 position = end, velocity(cloth_size);
    const Grid<float> inverse_mass(cloth_size, cloth_size, 1);
    const MovingCloth moving{start, position, velocity, inverse_mass};
    const Planes3* const ends[] = {&body_end};
    collider->move_bodies(ends, team);
    collider->detect(std::span(&moving, 1), step, team);
    const std::span<const Contact> found = collider->contacts(0);
    return {found.begin(), found.end()};
  }
  CollidingCloth cloth_properties;
  std::unique_ptr<Collider> collider;
  ThreadTeam team{2};
};

bool same(const Contact& a, const Contact& b) {
  return a.samples == b.samples && a.normal == b.normal && a.offset == b.offset &&
         a.surface_displacement == b.surface_displacement;
}

TEST(MovingContacts, WhatIsRememberedHidesNone) {
  const BorderMates none;
  Obstacles obstacles;
  obstacles.bodies.push_back(octahedral_sphere(obstacle_size, radius, {}));
  const Planes3 rest = obstacles.bodies[0].positions;
  Random random(5);
  Watch watch(obstacles, none);
  double time = 0;
  Planes3 start = cloth_at(0, random);
  std::size_t found = 0, samples = 0;
  for (int i = 0; i < 80; ++i) {
    // Now and then a step is refused, and tried anew in half the time.
    const bool refused = i % 7 == 3;
    const double next = time + (i % 7 == 4 ? 0.5 : 1) * step;
    const Planes3 body_start = ball_at(rest, time), body_end = ball_at(rest, next);
    const Planes3 end = cloth_at(next, random);
    const std::vector<Contact> remembered = watch.contacts(start, end, body_end);
    Obstacles now = obstacles;
    now.bodies[0].positions = body_start;
    now.bodies[0].shape = rest;
    const std::vector<Contact> fresh = Watch(now, none).contacts(start, end, body_end);
    EXPECT_TRUE(std::equal(remembered.begin(), remembered.end(), fresh.begin(), fresh.end(), same))
        << i << ": " << remembered.size() << " of " << fresh.size();
    found += fresh.size();
    samples += cloth_size * cloth_size;
    if (refused) {
      watch.collider->rollback();
      continue;
    }
    watch.collider->commit();
    start = end;
    time = next;
  }
  EXPECT_GT(found, samples / 100);
}

TEST(MovingContacts, ASecondLookSeesOtherEnds) {
  const BorderMates none;
  Obstacles obstacles;
  obstacles.bodies.push_back(octahedral_sphere(obstacle_size, radius, {}));
  const Planes3 rest = obstacles.bodies[0].positions, body_end = ball_at(rest, step);
  Random random(6);
  const Planes3 start = cloth_at(0, random);
  const Planes3 guess = cloth_at(step, random);
  Planes3 end = guess;
  for (int s = 0; s < cloth_size * cloth_size; ++s)
    end.set(s, end.at(s) + Vec3f{0, s % 3 == 0 ? -0.004F : 0.001F, 0});
  Watch watch(obstacles, none);
  const std::size_t first = watch.contacts(start, guess, body_end).size();
  const std::vector<Contact> second = watch.contacts(start, end, body_end);
  const std::vector<Contact> fresh = Watch(obstacles, none).contacts(start, end, body_end);
  EXPECT_TRUE(std::equal(second.begin(), second.end(), fresh.begin(), fresh.end(), same));
  EXPECT_NE(first, second.size());
}

TEST(MovingContacts, TheSmallestGapIsThatOfAllSamples) {
  const BorderMates none;
  Obstacles obstacles;
  obstacles.bodies.push_back(octahedral_sphere(obstacle_size, radius, {}));
  const Planes3 rest = obstacles.bodies[0].positions;
  Random random(8);
  Watch watch(obstacles, none);
  for (int i = 0; i < 8; ++i) {
    const Planes3 start = cloth_at(i * step, random), end = cloth_at((i + 1) * step, random);
    const Planes3 body_end = ball_at(rest, (i + 1) * step);
    watch.contacts(start, end, body_end);
    watch.collider->commit();
    Obstacles now = obstacles;
    now.bodies[0].positions = body_end;
    const double gap = watch.collider->smallest_gap(0, end, watch.team);
    EXPECT_EQ(gap, Watch(now, none).collider->smallest_gap(0, end, watch.team));
    EXPECT_LT(gap, 2 * gap_kept);
    EXPECT_GT(gap, -gap_kept);
  }
}

TEST(MovingContacts, BlocksNearAPlaceTellHowTheyMove) {
  const Body ball = octahedral_sphere(obstacle_size, radius, {});
  const SurfaceGrid grid(obstacle_size, ball.mates, {});
  Planes3 end = ball.positions;
  for (int s = 0; s < obstacle_size * obstacle_size; ++s)
    if (end.at(s).x > 0.1F) end.set(s, end.at(s) + Vec3f{0, 0.01F, 0});
  ThreadTeam team(2);
  BlockMotion motion;
  motion.measure(grid, ball.positions, end, nullptr, team);
  std::vector<int> list;
  const auto near = [&](Vec3f at) { return motion.near({at, at}, 0.01F, 0, list); };
  EXPECT_EQ(near({-0.25F, 0, 0}).approach, 0) << "the side that stands still";
  EXPECT_EQ(length(near({-0.25F, 0, 0}).displacement), 0);
  const BlockMotion::Near edge = near({0.1F, 0.22F, 0});
  EXPECT_GT(edge.displacement.y, 0);
  EXPECT_LT(edge.displacement.y, 0.01);
  EXPECT_NEAR(edge.approach, std::max(edge.displacement.y, 0.01 - edge.displacement.y), 1e-6)
      << "either side, seen from their mean";
  EXPECT_EQ(near({2, 0, 0}).approach, 0) << "nothing is there";
}

}  // namespace
}  // namespace weft
