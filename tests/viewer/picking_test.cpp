#include "apps/viewer/picking.h"

#include <gtest/gtest.h>

#include "tests/view/shapes.h"
#include "weft/core/random.h"

namespace weft::viewer {
namespace {

SubjectSurface surface_of(const Planes3& positions) {
  return {"it", {}, std::nullopt, positions, false};
}

Snapshot snapshot_of(const std::vector<Planes3>& cloths, const std::vector<Planes3>& bodies) {
  auto subject = std::make_shared<Subject>();
  Snapshot snapshot;
  for (const Planes3& cloth : cloths) subject->cloths.push_back(surface_of(cloth));
  for (const Planes3& body : bodies) subject->bodies.push_back(surface_of(body));
  snapshot.cloths = cloths;
  snapshot.bodies.resize(bodies.size());
  snapshot.subject = subject;
  return snapshot;
}

TEST(Picking, ARayStraightDownMeetsTheSampleBelowIt) {
  const Planes3 sheet = wavy_sheet(33, 0.4F);
  for (const int sample : {0, 40, 500, 33 * 33 - 1}) {
    const auto below = vec_cast<double>(sheet.at(sample));
    // Borders are met a hair inside.
    const Vec3d from{0.9999 * below.x, 2, 0.9999 * below.z};
    const auto hit = meet_grid({from, {0, -1, 0}}, sheet);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->sample, sample);
    EXPECT_NEAR(hit->distance, 2 - below.y, 2e-3);
  }
}

TEST(Picking, WhatIsMetFirstIsTheNearestOfAllTriangles) {
  const Planes3 ball = sphere_grid(41, {0, 0, 0}, 1);
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const Vec3d from = 3.0 * normalized(Vec3d{random.uniform() - 0.5, random.uniform() - 0.5,
                                              random.uniform() - 0.5});
    const Vec3d aim = 0.6 * Vec3d{random.uniform() - 0.5, random.uniform() - 0.5, 0};
    const Ray ray{from, normalized(aim - from)};
    const auto hit = meet_grid(ray, ball);
    ASSERT_TRUE(hit);
    // Of a ball the near side is met, within what its triangles lie below it.
    const double along = -dot(from, ray.direction);
    const double squared = squared_length(from) - along * along;
    EXPECT_NEAR(hit->distance, along - std::sqrt(1 - squared), 0.02);
    EXPECT_LT(length(from + hit->distance * ray.direction - vec_cast<double>(ball.at(hit->sample))),
              0.16);
  }
}

TEST(Picking, ARayPastEverythingMeetsNothing) {
  const Planes3 sheet = wavy_sheet(17, 0);
  EXPECT_FALSE(meet_grid({{0, 2, 0}, {0, 1, 0}}, sheet));
  EXPECT_FALSE(meet_grid({{1.5, 2, 0}, {0, -1, 0}}, sheet));
  EXPECT_FALSE(pick_cloth({{5, 2, 0}, {0, -1, 0}}, snapshot_of({sheet}, {})));
}

TEST(Picking, TheUpperOfTwoClothsIsTaken) {
  const Snapshot snapshot = snapshot_of({wavy_sheet(17, 0), wavy_sheet(33, 0.6F)}, {});
  const auto from_above = pick_cloth({{0.1, 3, 0.1}, {0, -1, 0}}, snapshot);
  const auto from_below = pick_cloth({{0.1, -3, 0.1}, {0, 1, 0}}, snapshot);
  ASSERT_TRUE(from_above && from_below);
  EXPECT_EQ(from_above->cloth, 1U);
  EXPECT_EQ(from_below->cloth, 0U);
  EXPECT_GT(from_above->point.y, 0.3);
}

TEST(Picking, ABodyInFrontHidesTheCloth) {
  const Snapshot snapshot = snapshot_of({wavy_sheet(33, 0)}, {sphere_grid(33, {0, 1, 0}, 0.3F)});
  EXPECT_FALSE(pick_cloth({{0, 3, 0}, {0, -1, 0}}, snapshot));
  EXPECT_TRUE(pick_cloth({{0.6, 3, 0}, {0, -1, 0}}, snapshot));
  EXPECT_TRUE(pick_cloth({{0, -3, 0}, {0, 1, 0}}, snapshot));
}

}  // namespace
}  // namespace weft::viewer
