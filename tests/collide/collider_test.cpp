#include "weft/collide/collider.h"

#include <gtest/gtest.h>

#include "tests/collide/test_bodies.h"

namespace weft::collider_test {
namespace {

using test::octahedral_sphere;
using test::polar_collider;
using test::TestCloth;

constexpr int n = 9;
constexpr double step = 1.0 / 240;
constexpr double g = 9.81;

std::span<const Contact> detect(Collider& collider, TestCloth& cloth, ThreadTeam& team) {
  const MovingCloth moving = cloth.moving();
  collider.detect(std::span(&moving, 1), step, team);
  return collider.contacts(0);
}

std::unique_ptr<Collider> on_ground(double ground_friction, double cloth_friction) {
  Obstacles obstacles;
  obstacles.ground = 0;
  obstacles.ground_friction = ground_friction;
  return polar_collider(obstacles, 0.002, cloth_friction);
}

/// A sheet without springs lying on the ground, sliding along x; semi-implicit Euler under gravity.
double surface_displacement(Collider& collider, double speed, int steps) {
  TestCloth cloth(n);
  cloth.place([](int r, int c) { return Vec3d{0.1 * c, 0.002, 0.1 * r}; });
  for (int s = 0; s < n * n; ++s) cloth.velocity.set(s, {static_cast<float>(speed), 0, 0});
  ThreadTeam team(1);
  for (int i = 0; i < steps; ++i) {
    cloth.start = cloth.position;
    for (int s = 0; s < n * n; ++s) {
      const Vec3d v = vec_cast<double>(cloth.velocity.at(s)) + Vec3d{0, -g * step, 0};
      cloth.velocity.set(s, vec_cast<float>(v));
      cloth.position.set(s, vec_cast<float>(vec_cast<double>(cloth.position.at(s)) + step * v));
    }
    collider.correct(0, cloth.moving(), {}, step, team);
  }
  return cloth.velocity.at(n + 1).x;
}

TEST(Collider, GroundHoldsTheThickness) {
  const auto collider = on_ground(0.5, 0.5);
  TestCloth cloth(n);
  cloth.place([](int r, int c) { return Vec3d{0.1 * c, -0.01 * r, 0.1 * r}; });
  for (int s = 0; s < n * n; ++s) cloth.velocity.set(s, {0, -1, 0});
  ThreadTeam team(2);
  EXPECT_EQ(collider->correct(0, cloth.moving(), {}, step, team), n * n);
  for (int s = 0; s < n * n; ++s) {
    EXPECT_NEAR(cloth.position.at(s).y, 0.002, 1e-8);
    EXPECT_EQ(cloth.velocity.at(s).y, 0);
  }
}

TEST(Collider, SlidingSlowsByFrictionTimesGravity) {
  // Coulomb: the speed falls by mu g t; mu of the pair is the geometric mean of 0.1 and 0.4.
  EXPECT_NEAR(surface_displacement(*on_ground(0.1, 0.4), 1.0, 48), 1.0 - 0.2 * g * 48 * step, 2e-3);
}

TEST(Collider, SlidingStopsAndStaysStopped) {
  EXPECT_NEAR(surface_displacement(*on_ground(0.5, 0.5), 0.3, 48), 0, 1e-7);
}

TEST(Collider, WithoutFrictionSlidingGoesOn) {
  EXPECT_NEAR(surface_displacement(*on_ground(0, 0.5), 1.0, 48), 1.0, 1e-6);
}

TEST(Collider, PinnedParticlesAreNeverMoved) {
  const auto collider = on_ground(0.5, 0.5);
  TestCloth cloth(n);
  cloth.place([](int r, int c) { return Vec3d{0.1 * c, -0.05, 0.1 * r}; });
  cloth.inverse_mass(0, 0) = 0;
  ThreadTeam team(1);
  EXPECT_EQ(detect(*collider, cloth, team).size(), n * n - 1);
  EXPECT_EQ(collider->correct(0, cloth.moving(), {}, step, team), n * n - 1);
  EXPECT_EQ(cloth.position.at(0).y, -0.05F);
}

TEST(Collider, ContactsAreHalfSpacesThatTouchTheSphere) {
  Obstacles obstacles;
  obstacles.bodies.push_back(octahedral_sphere(65, 0.5, {}));
  const auto collider = polar_collider(obstacles, 0.004, 0.4);
  TestCloth cloth(n);
  cloth.place([](int r, int c) { return Vec3d{0.1 * c - 0.4, 0.49, 0.1 * r - 0.4}; });
  ThreadTeam team(2);
  const auto contacts = detect(*collider, cloth, team);
  ASSERT_FALSE(contacts.empty());
  int before = -1;
  for (const Contact& contact : contacts) {
    EXPECT_GT(contact.samples[0], before);
    before = contact.samples[0];
    // The plane touches the sphere of radius 0.5 + thickness, up to its facets.
    EXPECT_NEAR(contact.offset, 0.504, 1e-3);
    EXPECT_LT(dot(contact.normal, cloth.position.at(contact.samples[0])), contact.offset);
    EXPECT_NEAR(contact.friction, 0.4, 1e-6);
  }
}

TEST(Collider, TeamsOfAnySizeGiveTheSameBits) {
  Obstacles obstacles;
  obstacles.bodies.push_back(octahedral_sphere(33, 0.5, {}));
  obstacles.bodies.push_back(octahedral_sphere(17, 0.3, {0.4, 0.2, 0}));
  obstacles.ground = -0.1;
  const auto run = [&](int threads) {
    const auto collider = polar_collider(obstacles, 0.01, 0.4);
    TestCloth cloth(33);
    cloth.place([](int r, int c) {
      return Vec3d{0.03 * c - 0.5, 0.02 * r - 0.2, 0.01 * (r + c) - 0.3};
    });
    for (int s = 0; s < 33 * 33; ++s) cloth.velocity.set(s, {0.3F, -1, 0.1F});
    ThreadTeam team(threads);
    collider->correct(0, cloth.moving(), {}, step, team);
    return cloth;
  };
  const TestCloth one = run(1), three = run(3);
  for (int s = 0; s < 33 * 33; ++s) {
    EXPECT_EQ(one.position.at(s), three.position.at(s));
    EXPECT_EQ(one.velocity.at(s), three.velocity.at(s));
  }
}

TEST(Collider, HasItsNameInTheSceneFile) { EXPECT_EQ(name_of(PolarMapOptions{}), "polar_map"); }

}  // namespace
}  // namespace weft::collider_test
