#include "weft/collide/contacts/contact_response.h"

#include <gtest/gtest.h>

#include "tests/collide/test_bodies.h"
#include "weft/core/contact_point.h"
#include "weft/core/random.h"

namespace weft::contact_response_test {
namespace {

using test::TestCloth;

constexpr int n = 9;
constexpr double h = 1.0 / 240;
constexpr double g = 9.81;
const Vec3f up{0, 1, 0};

int respond(TestCloth& cloth, const PressedContacts& pressed, const BorderMates& mates = {},
            int threads = 1) {
  ThreadTeam team(threads);
  ContactResponse response(mates);
  return response.respond(cloth.moving(), pressed, h, team);
}

TestCloth sheet_at(double height) {
  TestCloth cloth(n);
  cloth.place([&](int r, int c) { return Vec3d{0.1 * c + 0.03, height, 0.1 * r + 0.07}; });
  return cloth;
}

/// Lone particles under gravity on a plane through the origin of normal (-s, c, 0); the force is
/// what such a plane presses with. @return how far particle 20 went down the plane
double slide_down(double tangent, double friction, int steps) {
  const double cosine = 1 / std::sqrt(1 + tangent * tangent), sine = tangent * cosine;
  const Vec3f normal = vec_cast<float>(Vec3d{-sine, cosine, 0});
  TestCloth cloth(n);
  cloth.place([&](int r, int c) {
    return Vec3d{0.1 * c * cosine + 0.03, 0.1 * c * sine, 0.1 * r} +
           0.02 * vec_cast<double>(normal);
  });
  std::vector<Contact> contacts;
  for (int s = 0; s < n * n; ++s)
    contacts.push_back({{s}, {1}, normal, dot(normal, cloth.start.at(s)), float(friction), {}});
  const std::vector<float> forces(contacts.size(), static_cast<float>(g * cosine));
  const Vec3d begin = vec_cast<double>(cloth.start.at(20));
  ThreadTeam team(1);
  const BorderMates mates;
  ContactResponse response(mates);
  for (int i = 0; i < steps; ++i) {
    cloth.start = cloth.position;
    for (int s = 0; s < n * n; ++s) {
      // As a solver does it: the plane's force within the step.
      const Vec3d v = vec_cast<double>(cloth.velocity.at(s)) +
                      h * (Vec3d{0, -g, 0} + g * cosine * vec_cast<double>(normal));
      cloth.velocity.set(s, vec_cast<float>(v));
      cloth.position.set(s, vec_cast<float>(vec_cast<double>(cloth.position.at(s)) + h * v));
    }
    response.respond(cloth.moving(), {contacts, forces}, h, team);
  }
  return dot(begin - vec_cast<double>(cloth.position.at(20)), Vec3d{cosine, sine, 0});
}

TEST(ContactResponse, StickingSticksToTheBit) {
  EXPECT_EQ(slide_down(0.5, 0.501, 2000), 0);
  EXPECT_EQ(slide_down(0.1, 0.3, 2000), 0);
}

TEST(ContactResponse, SlidingFollowsCoulomb) {
  const double seconds = 0.5, wanted = g / std::sqrt(1.25) * (0.5 - 0.4) * seconds * seconds / 2;
  EXPECT_NEAR(slide_down(0.5, 0.4, 120), wanted, 0.01 * wanted);
}

TEST(ContactResponse, SlidingMotionComesToAStop) {
  TestCloth cloth = sheet_at(0);
  cloth.velocity.set(20, {0.3F, 0, 0.1F});
  const Contact floor{{20}, {1}, up, 0, 0.5F, {}};
  const float force = g;
  ThreadTeam team(1);
  const BorderMates mates;
  ContactResponse response(mates);
  for (int i = 0; i < 48; ++i) {
    cloth.start = cloth.position;
    const Vec3d v = vec_cast<double>(cloth.velocity.at(20));
    cloth.position.set(20, vec_cast<float>(vec_cast<double>(cloth.position.at(20)) + h * v));
    response.respond(cloth.moving(), {{&floor, 1}, {&force, 1}}, h, team);
  }
  EXPECT_EQ(cloth.velocity.at(20), Vec3f{});
  const double speed = std::sqrt(0.1), way = speed * speed / (2 * 0.5 * g) - speed * h / 2;
  EXPECT_NEAR(length(cloth.position.at(20) - Vec3f{0.23F, 0, 0.27F}), way, 0.03 * way);
}

TEST(ContactResponse, WhatEntersIsPushedOutAndStopped) {
  TestCloth cloth = sheet_at(-0.01);
  for (int s = 0; s < n * n; ++s) cloth.velocity.set(s, {0.5F, -2, 0});
  std::vector<Contact> floor;
  for (int s = 0; s < n * n; ++s) floor.push_back({{s}, {1}, up, 0.002F, 0, {}});
  EXPECT_EQ(respond(cloth, {floor, {}}), n * n);
  for (int s = 0; s < n * n; ++s) {
    EXPECT_NEAR(cloth.position.at(s).y, 0.002, 1e-8);
    EXPECT_NEAR(length(cloth.velocity.at(s) - Vec3f{0.5F, 0, 0}), 0, 1e-7);
  }
}

TEST(ContactResponse, PartsOfAClothPushEachOtherByTheirMasses) {
  TestCloth cloth = sheet_at(0);
  cloth.inverse_mass(5, 1) = 3;
  const Contact pair{{11, 46, 47, 55}, {1, -0.5F, -0.3F, -0.2F}, up, 0.003F, 0.4F, {}};
  cloth.velocity.set(11, {0.4F, -1, 0});
  EXPECT_EQ(respond(cloth, {{&pair, 1}, {}}), 0) << "no obstacle";
  EXPECT_NEAR(depth_of(pair, cloth.position), 0, 1e-8);
  Vec3d moment, impulse;
  for (int s = 0; s < n * n; ++s) {
    const double mass = 1 / double{cloth.inverse_mass(s / n, s % n)};
    moment += mass * vec_cast<double>(cloth.position.at(s) - cloth.start.at(s));
    impulse += mass * vec_cast<double>(cloth.velocity.at(s));
  }
  EXPECT_NEAR(length(moment), 0, 1e-7);
  EXPECT_NEAR(length(impulse - Vec3d{0.4, -1, 0}), 0, 1e-6);
  EXPECT_GT(cloth.velocity.at(46).x, 0) << "friction drags the triangle along";
}

TEST(ContactResponse, ParticlesBetweenTwoWallsEndInTheCorner) {
  TestCloth cloth = sheet_at(0);
  const float wall = cloth.position.at(20).x + 0.01F;
  const std::vector<Contact> corner{{{20}, {1}, up, 0.004F, 0, {}},
                                    {{20}, {1}, {1, 0, 0}, wall, 0, {}}};
  respond(cloth, {corner, {}});
  EXPECT_NEAR(cloth.position.at(20).y, 0.004, 2e-4);
  EXPECT_NEAR(cloth.position.at(20).x, wall, 2e-4);
}

TEST(ContactResponse, ObstaclesDragWhatSticksToThem) {
  TestCloth cloth = sheet_at(0);
  const Contact belt{{20}, {1}, up, 0, 0.5F, {5e-5F, 0, 0}};
  const float force = g;
  const Vec3f before = cloth.position.at(20);
  respond(cloth, {{&belt, 1}, {&force, 1}});
  EXPECT_NEAR(cloth.position.at(20).x, before.x + 5e-5, 3e-8);
  EXPECT_NEAR(cloth.velocity.at(20).x, 5e-5 / h, 1e-6);
}

TEST(ContactResponse, MatesStayEqualAndPinsWhereTheyAre) {
  const Body seamed = test::torus(n, 0.4, 0.1);
  TestCloth cloth(n);
  cloth.position = cloth.start = seamed.positions;
  cloth.inverse_mass(4, 4) = 0;
  std::vector<Contact> contacts;
  // Every other sample names its class, some of them through their mates.
  for (int s = 0; s < n * n; s += 2)
    contacts.push_back({{s}, {1}, up, cloth.start.at(s).y + 0.01F, 0.4F, {}});
  contacts.push_back({{0, 4 * n, 4 * n + 8, 3}, {0.5F, -0.2F, -0.3F, 0.5F}, up, 0.2F, 0.4F, {}});
  respond(cloth, {contacts, {}}, seamed.mates);
  for (int index = 0; index < seamed.mates.class_count(); ++index)
    for (const int s : seamed.mates.mates(index)) {
      EXPECT_EQ(cloth.position.at(s), cloth.position.at(seamed.mates.mates(index)[0]));
      EXPECT_EQ(cloth.velocity.at(s), cloth.velocity.at(seamed.mates.mates(index)[0]));
    }
  EXPECT_EQ(cloth.position.at(4, 4), cloth.start.at(4, 4));
  EXPECT_NEAR(cloth.position.at(2, 2).y, cloth.start.at(2, 2).y + 0.01, 1e-7);
  EXPECT_EQ(cloth.position.at(2, 3), cloth.start.at(2, 3)) << "no contact";
}

TEST(ContactResponse, TeamsOfAnySizeGiveTheSameBits) {
  const auto run = [&](int threads) {
    TestCloth cloth = sheet_at(0);
    Random random(7);
    std::vector<Contact> contacts;
    std::vector<float> forces;
    const auto any = [&] { return static_cast<int>(random.uniform(0, n * n - 0.5)); };
    for (int i = 0; i < 200; ++i) {
      const Vec3f normal = normalized(Vec3f{float(random.uniform(-1, 1)), 1, 0.3F});
      Contact contact{
          {any(), any(), any(), any()}, {0.5F, 0.5F, -0.4F, -0.6F}, normal, 0, 0.4F, {}};
      contact.offset = static_cast<float>(depth_of(contact, cloth.position) * -1 + 0.01);
      contacts.push_back(contact);
      forces.push_back(static_cast<float>(random.uniform(0, 5)));
    }
    for (int s = 0; s < n * n; ++s) cloth.velocity.set(s, {0.3F, -1, 0.1F});
    respond(cloth, {contacts, forces}, {}, threads);
    return cloth;
  };
  const TestCloth one = run(1), three = run(3);
  for (int s = 0; s < n * n; ++s) {
    EXPECT_EQ(one.position.at(s), three.position.at(s));
    EXPECT_EQ(one.velocity.at(s), three.velocity.at(s));
  }
}

}  // namespace
}  // namespace weft::contact_response_test
