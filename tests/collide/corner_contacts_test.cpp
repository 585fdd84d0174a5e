#include "weft/collide/contacts/corner_contacts.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/collide/test_bodies.h"
#include "weft/collide/contacts/sharp_points.h"
#include "weft/core/contact_point.h"

namespace weft::corner_contacts_test {
namespace {

using test::octahedron;
using test::TestCloth;

constexpr double step = 1.0 / 240, gap = 0.004, spacing = 0.1;

std::vector<int> sharp_points_of(const Body& body, const Sharpness& sharpness) {
  const SurfaceGrid grid(body.positions.size(), body.mates, {});
  BodyQuery query(grid);
  ThreadTeam team(1);
  query.place(body.positions, team);
  return find_sharp_points(grid, query, body.positions, sharpness);
}

TEST(SharpPoints, AreTheEdgesAndTipsOfAnOctahedron) {
  const Body body = octahedron(33, {0.5, 0.5, 0.5}, {});
  const SurfaceGrid grid(33, body.mates, {});
  std::vector<int> edges;
  for (int s = 0; s < 33 * 33; ++s) {
    const Vec3f p = body.positions.at(s);
    const float min = std::min({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (grid.point(s) == s && min < 1e-6F) edges.push_back(s);
  }
  ASSERT_GT(edges.size(), 100U);
  EXPECT_EQ(sharp_points_of(body, {0.002, 0.005, 0.003}), edges);
}

TEST(SharpPoints, AreToldByHowFarTheSurfaceFallsBack) {
  // Of a ball of radius R: where (R + 2 mm)^2 + (5 mm)^2 > (R + 3 mm)^2, that is R < 10 mm.
  const Sharpness sharpness{0.002, 0.005, 0.003};
  EXPECT_TRUE(sharp_points_of(test::octahedral_sphere(33, 0.011, {}), sharpness).empty());
  const std::vector<int> all = sharp_points_of(test::octahedral_sphere(33, 0.005, {}), sharpness);
  EXPECT_EQ(all.size(), 4U * 16 * 16 + 2);
}

TEST(SharpPoints, AreTheRimOfAnOpenSheet) {
  Body sheet;
  sheet.positions = Planes3(9);
  for (int s = 0; s < 81; ++s)
    sheet.positions.set(s, {0.1F * static_cast<float>(s % 9), 0, 0.1F * static_cast<float>(s / 9)});
  sheet.mates = BorderMates(9, {});
  const std::vector<int> rim = sharp_points_of(sheet, {0.002, 0.02, 0.003});
  EXPECT_EQ(rim.size(), 32U);
  for (const int s : rim) EXPECT_TRUE(s / 9 == 0 || s / 9 == 8 || s % 9 == 0 || s % 9 == 8) << s;
}

CollidingCloth statistics(const BorderMates& mates, int n) {
  return {.mates = mates, .size = n, .thickness = gap, .friction = 0.4, .rest_spacing = spacing};
}

/// A flat sheet in the xz plane about the origin, with an octahedron below whose upper tip is at
/// (0.02, -depth, 0.03), far from all samples.
struct SheetOnTip {
  static constexpr int n = 6;
  explicit SheetOnTip(double below) : cloth(n), cloth_properties(statistics(none, n)) {
    obstacles.bodies.push_back(octahedron(17, {0.3, 0.6, 0.3}, {0.02, -0.6 - below, 0.03}));
    collider = make_collider(PyramidOptions{}, obstacles, std::span(&cloth_properties, 1));
    cloth.place([](int r, int c) { return Vec3d{spacing * (c - 2.5), 0, spacing * (r - 2.5)}; });
  }
  void fall(double distance) {
    for (int s = 0; s < n * n; ++s) {
      cloth.position.set(s, cloth.start.at(s) - Vec3f{0, static_cast<float>(distance), 0});
      cloth.velocity.set(s, {0, static_cast<float>(-distance / step), 0});
    }
  }
  std::span<const Contact> detect(int threads = 2) {
    ThreadTeam team(threads);
    const MovingCloth moving = cloth.moving();
    collider->detect(std::span(&moving, 1), step, team);
    return collider->contacts(0);
  }

  const BorderMates none;
  Obstacles obstacles;
  TestCloth cloth;
  CollidingCloth cloth_properties;
  std::unique_ptr<Collider> collider;
};

TEST(CornerContacts, ATipBetweenSamplesIsFoundUnderTheInsideOfATriangle) {
  SheetOnTip scene(0.01);
  scene.fall(0.02);
  const std::span<const Contact> found = scene.detect();
  ASSERT_EQ(found.size(), 1U);
  const Contact& contact = found[0];
  const Vec3d at = point_of(contact, scene.cloth.start);
  EXPECT_NEAR(length(at - Vec3d{0.02, 0, 0.03}), 0, 1e-6);
  EXPECT_NEAR(contact.normal.y, 1, 1e-6);
  EXPECT_NEAR(contact.offset, -0.01 + gap, 1e-6);
  EXPECT_EQ(contact.surface_displacement, Vec3f{});
  EXPECT_NEAR(contact.friction, 0.4, 1e-6);
}

TEST(CornerContacts, NothingIsFoundWhereTheStepDoesNotLeadNear) {
  SheetOnTip scene(0.03);
  scene.fall(0.02);
  EXPECT_TRUE(scene.detect().empty());
}

TEST(CornerContacts, TheResponseHoldsTheInsideOfTheTriangleAtTheGap) {
  SheetOnTip scene(0.01);
  scene.fall(0.02);
  const Contact contact = scene.detect()[0];
  ThreadTeam team(2);
  EXPECT_EQ(scene.collider->correct(0, scene.cloth.moving(), {}, step, team), 3);
  EXPECT_NEAR(point_of(contact, scene.cloth.position).y, -0.01 + gap, 1e-6);
  EXPECT_NEAR(point_of(contact, scene.cloth.velocity).y, 0, 1e-4);
  // By what its samples' weights ask for, and no other sample.
  for (int s = 0; s < SheetOnTip::n * SheetOnTip::n; ++s) {
    double weight = 0;
    for (std::size_t k = 0; k < 4; ++k)
      if (contact.samples[k] == s) weight += contact.weights[k];
    const double pushed = double{scene.cloth.position.at(s).y} + 0.02;
    EXPECT_NEAR(pushed > 1e-6, weight > 0, 0) << s;
  }
}

TEST(CornerContacts, WhatStartsNearerThanTheGapIsLiftedByPartOfIt) {
  SheetOnTip scene(0.001);
  scene.fall(0);
  const std::span<const Contact> found = scene.detect();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].offset, 0, 1e-6);
  EXPECT_NEAR(found[0].lift, 0.25 * gap, 1e-6);
}

TEST(CornerContacts, ATipThatRisesTakesItsHalfSpaceAlong) {
  SheetOnTip scene(0.01);
  Planes3 end = scene.obstacles.bodies[0].positions;
  for (int s = 0; s < 17 * 17; ++s) end.set(s, end.at(s) + Vec3f{0.002F, 0.008F, 0});
  const Planes3* const ends[] = {&end};
  ThreadTeam team(1);
  scene.collider->move_bodies(ends, team);
  const std::span<const Contact> found = scene.detect();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].offset, -0.01 + 0.008 + gap, 1e-6);
  EXPECT_NEAR(length(vec_cast<double>(found[0].surface_displacement) - Vec3d{0.002, 0.008, 0}), 0,
              1e-6);
}

TEST(CornerContacts, WhatIsSharpIsToldByTheShapeAndNotByTheMoment) {
  SheetOnTip scene(0.01);
  scene.obstacles.bodies[0].shape = octahedron(17, {0.3, 0.001, 0.3}, {}).positions;
  scene.collider =
      make_collider(PyramidOptions{}, scene.obstacles, std::span(&scene.cloth_properties, 1));
  scene.fall(0.02);
  EXPECT_TRUE(scene.detect().empty());
}

TEST(CornerContacts, ATipUnderAnEdgeOfTwoTrianglesHasOneContact) {
  SheetOnTip scene(0.01);
  // The sheet is moved until the edge between two samples lies above the tip.
  scene.cloth.place([](int r, int c) {
    return Vec3d{spacing * (c - 2.4) + 0.02, 0, spacing * (r - 2) + 0.03};
  });
  scene.fall(0.02);
  const std::span<const Contact> found = scene.detect();
  ASSERT_EQ(found.size(), 1U);
  const auto& w = found[0].weights;
  EXPECT_EQ(std::count_if(w.begin(), w.end(), [](float x) { return x > 1e-6F; }), 2);
  EXPECT_NEAR(length(point_of(found[0], scene.cloth.start) - Vec3d{0.02, 0, 0.03}), 0, 1e-6);
}

TEST(CornerContacts, AreOnTheSideWhereTheClothLies) {
  // The rim of an open body knows no inside: cloth is kept where it is, above or below.
  for (const double side : {1.0, -1.0}) {
    const BorderMates none;
    Body sheet;
    sheet.positions = Planes3(9);
    for (int s = 0; s < 81; ++s)
      sheet.positions.set(
          s, {0.05F * static_cast<float>(s % 9), 0, 0.05F * static_cast<float>(s / 9)});
    sheet.mates = BorderMates(9, {});
    const CollidingCloth cloth_properties = statistics(none, 4);
    const auto collider =
        make_collider(PyramidOptions{}, Obstacles{{sheet}, {}, 0}, std::span(&cloth_properties, 1));
    TestCloth cloth(4);
    // One corner of the rim is below the middle of a triangle.
    cloth.place([&](int r, int c) {
      return Vec3d{spacing * (c - 1.7), 0.008 * side, spacing * (r - 1.5)};
    });
    for (int s = 0; s < 16; ++s)
      cloth.position.set(s, cloth.start.at(s) - Vec3f{0, static_cast<float>(0.01 * side), 0});
    ThreadTeam team(1);
    const MovingCloth moving = cloth.moving();
    collider->detect(std::span(&moving, 1), step, team);
    int inner = 0;
    for (const Contact& contact : collider->contacts(0)) {
      EXPECT_NEAR(contact.normal.y, side, 1e-6);
      inner += contact.weights[1] != 0 ? 1 : 0;
    }
    EXPECT_GT(inner, 0);
  }
}

TEST(CornerContacts, TeamsOfAnySizeFindTheSame) {
  const auto found = [](int threads) {
    constexpr int n = 33;
    const BorderMates none;
    CollidingCloth cloth_properties = statistics(none, n);
    cloth_properties.rest_spacing = 0.02;
    Obstacles obstacles;
    for (const double x : {-0.1, 0.1})
      obstacles.bodies.push_back(octahedron(33, {0.2, 0.05, 0.2}, {x, -0.05, 0}));
    const auto collider =
        make_collider(PyramidOptions{}, obstacles, std::span(&cloth_properties, 1));
    TestCloth cloth(n);
    cloth.place([](int r, int c) { return Vec3d{0.02 * (c - 16), 0.005, 0.02 * (r - 16)}; });
    for (int s = 0; s < n * n; ++s) cloth.position.set(s, cloth.start.at(s) - Vec3f{0, 0.03F, 0});
    ThreadTeam team(threads);
    const MovingCloth moving = cloth.moving();
    collider->detect(std::span(&moving, 1), step, team);
    std::vector<float> numbers;
    for (const Contact& contact : collider->contacts(0)) {
      if (contact.weights[1] == 0) continue;
      for (const float x : {contact.weights[0], contact.weights[1], contact.normal.x,
                            contact.offset, static_cast<float>(contact.samples[0])})
        numbers.push_back(x);
    }
    return numbers;
  };
  const std::vector<float> one = found(1);
  EXPECT_GT(one.size(), 5U * 10);
  for (const int threads : {2, 3, 7}) EXPECT_EQ(found(threads), one);
}

}  // namespace
}  // namespace weft::corner_contacts_test
