#include "weft/collide/contacts/contact_body.h"

#include <gtest/gtest.h>

#include "tests/collide/test_bodies.h"

namespace weft {
namespace {

constexpr KeptGap kept{0.004, 0.9};

/// An octahedron of half a metre about the origin; its faces are at 1 / sqrt(3) of that.
struct StandingOctahedron {
  StandingOctahedron()
      : given(test::octahedron(17, {0.5, 0.5, 0.5}, {})),
        grid(17, given.mates, {}),
        query(grid),
        end(given.positions) {
    ThreadTeam alone(1);
    query.place(given.positions, alone);
    body.number = 1;
    body.query = &query;
    body.start = body.end = &given.positions;
    body.friction = 0.4;
  }
  void move(Vec3d by) {
    for (int s = 0; s < 17 * 17; ++s) end.set(s, given.positions.at(s) + vec_cast<float>(by));
    body.end = &end;
  }
  [[nodiscard]] BodyPoint closest(Vec3d place) const { return *query.closest(place, HUGE_VAL); }

  Body given;
  SurfaceGrid grid;
  BodyQuery query;
  Planes3 end;
  ContactBody body;
};

/// A place at a height above the middle of the face whose normal is along (1, 1, 1).
ClothPoint above_face(double height) {
  const double along = (0.5 / std::sqrt(3.0) + height) / std::sqrt(3.0);
  ClothPoint point;
  point.start = {along, along, along};
  return point;
}
constexpr double third = 0.57735026918962576;

TEST(ContactBody, NormalsLeadOutFromBothSides) {
  const StandingOctahedron scene;
  for (const double height : {0.01, -0.01}) {
    ClothPoint point = above_face(height);
    point.astray = height < 0;
    const PlaceBefore before = place_before(scene.body, scene.closest(point.start), point);
    EXPECT_NEAR(before.gap, height, 1e-6);
    EXPECT_NEAR(dot(before.normal, {third, third, third}), 1, 1e-6) << height;
  }
}

/// There the way from the surface is rounding.
TEST(ContactBody, OnTheSurfaceItsOwnNormalCounts) {
  const StandingOctahedron scene;
  ClothPoint point = above_face(0);
  EXPECT_GT(place_before(scene.body, scene.closest(point.start), point).normal.y, 0.57);
  point.kept_in = true;
  EXPECT_LT(place_before(scene.body, scene.closest(point.start), point).normal.y, -0.57);
}

TEST(ContactBody, OffsetsAreAGapAwayOrWhereThePointIsAlready) {
  Contact contact;
  put_offset(0.1, 0.02, 0.004, contact);
  EXPECT_FLOAT_EQ(contact.offset, 0.104F);
  EXPECT_FLOAT_EQ(contact.lift, 0);
  put_offset(0.1, 0.0035, 0.004, contact);
  EXPECT_FLOAT_EQ(contact.offset, 0.1035F);
  EXPECT_FLOAT_EQ(contact.lift, 0.0005F);
  put_offset(0.1, -0.02, 0.004, contact);
  EXPECT_FLOAT_EQ(contact.offset, 0.08F);
  EXPECT_FLOAT_EQ(contact.lift, 0.001F) << "a quarter of the gap at most";
}

TEST(ContactBody, WhatComesBackIsCarriedByTheSurface) {
  Contact contact;
  contact.normal = {0, 1, 0};
  contact.friction = 0.5F;
  put_offset(0.1, -0.02, 0.004, contact);
  Contact slow = contact;
  bring_back(HUGE_VAL, contact);
  EXPECT_FLOAT_EQ(contact.offset, 0.081F);
  EXPECT_FLOAT_EQ(contact.surface_displacement.y, 0.001F);
  EXPECT_EQ(contact.lift, 0);
  EXPECT_EQ(contact.friction, 0);
  bring_back(0.0003, slow);
  EXPECT_FLOAT_EQ(slow.offset, 0.0803F);
}

TEST(ContactBody, ASurfaceThatApproachesTakesItsHalfSpaceAlong) {
  StandingOctahedron scene;
  scene.move({0.001, 0.001, 0.001});
  ClothPoint point = above_face(0.004);
  const auto contact = contact_before(scene.body, scene.closest(point.start), point, kept);
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact->offset, 0.5 * third + 0.001 / third + 0.004, 1e-6);
  EXPECT_NEAR(contact->surface_displacement.x, 0.001F, 1e-7);
  EXPECT_NEAR(contact->friction, 0.6, 1e-6) << "the geometric mean";
}

TEST(ContactBody, ThereIsNoneForWhatStaysAwayOrGoesAway) {
  const StandingOctahedron scene;
  ClothPoint point = above_face(0.007);
  const BodyPoint at = scene.closest(point.start);
  EXPECT_FALSE(contact_before(scene.body, at, point, kept));
  point.displacement = {-0.002, -0.002, -0.002};
  EXPECT_TRUE(contact_before(scene.body, at, point, kept));
  point.start = above_face(0.004).start;
  point.displacement = {0.003, 0.003, 0.003};
  EXPECT_FALSE(contact_before(scene.body, scene.closest(point.start), point, kept));
}

TEST(ContactBody, APointOfATriangleIsTheMeanOfItsCorners) {
  test::TestCloth cloth(3);
  cloth.place([](int r, int c) { return Vec3d{1.0 * c, 0, 1.0 * r}; });
  cloth.position.set(1, {1, 0.5F, 0});
  const ClothPoint point = point_of_triangle(cloth.moving(), {0, 1, 3}, {0.25, 0.5, 0.25});
  EXPECT_EQ(point.start, (Vec3d{0.5, 0, 0.25}));
  EXPECT_EQ(point.displacement, (Vec3d{0, 0.25, 0}));
  EXPECT_EQ(point.samples, (std::array{0, 1, 3, 0}));
  EXPECT_EQ(point.weights, (std::array{0.25F, 0.5F, 0.25F, 0.0F}));
}

}  // namespace
}  // namespace weft
