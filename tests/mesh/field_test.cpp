#include "weft/mesh/shapes/field.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/random_points.h"
#include "weft/core/random.h"
#include "weft/mesh/shapes/rings.h"

namespace weft {
namespace {

using test::random_point;

TEST(Field, RoundConeIsTheUnionOfItsBalls) {
  const RoundCone cone{{-0.4, 0.1, 0}, {0.5, -0.2, 0.3}, 0.4, 0.15};
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Vec3d p = random_point(random);
    double min = HUGE_VAL;
    for (int k = 0; k <= 2000; ++k) {
      const double t = k / 2000.0;
      const Vec3d centre = (1 - t) * cone.a + t * cone.b;
      min = std::min(min, length(p - centre) - ((1 - t) * cone.radius_a + t * cone.radius_b));
    }
    EXPECT_NEAR(distance_to(cone, p), min, 1e-6);
    EXPECT_LE(distance_to(cone, p), min + 1e-15);
  }
}

TEST(Field, EllipsoidIsZeroWithUnitGradientOnItsSurface) {
  const Ellipsoid ellipsoid{{0.1, 0.2, 0.3}, {0.5, 0.3, 0.2}};
  const Field field = [&](Vec3d p) { return distance_to(ellipsoid, p); };
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const Vec3d d = normalized(random_point(random));
    const Vec3d p = ellipsoid.centre + Vec3d{0.5 * d.x, 0.3 * d.y, 0.2 * d.z};
    EXPECT_NEAR(field(p), 0, 1e-15);
    EXPECT_NEAR(length(gradient(field, p)), 1, 1e-5);
  }
  EXPECT_EQ(field(ellipsoid.centre), -0.2);
  EXPECT_NEAR(distance_to(Ellipsoid{{}, {2, 2, 2}}, {0, 5, 0}), 3, 1e-15);
}

TEST(Field, SmoothMinIsTheMinimumBeyondItsBlendAndBelowItWithin) {
  EXPECT_EQ(smooth_min(1.0, 2.0, 0.5), 1);
  EXPECT_EQ(smooth_min(2.0, 1.0, 1.0), 1);
  EXPECT_EQ(smooth_min(1.0, 1.0, 0.4), 1 - 0.1);
  EXPECT_EQ(smooth_max(1.0, 1.0, 0.4), 1 + 0.1);
  // Once differentiable where the two cross and where the blend begins.
  for (const double b : {0.6, 1.0, 1.4}) {
    const double h = 1e-6;
    const auto slope = [&](double x) {
      return (smooth_min(1, x + h, 0.4) - smooth_min(1, x - h, 0.4)) / (2 * h);
    };
    EXPECT_NEAR(slope(b - 1e-4), slope(b + 1e-4), 1e-3) << b;
  }
}

TEST(Field, LimbRunsThroughItsJointsWithTheirRadii) {
  const std::array<Limb::Joint, 4> joints{
      {{{0, 0, 0}, 0.1}, {{0.5, 0, 0}, 0.2}, {{1, 0.3, 0}, 0.1}, {{1.5, 0.3, 0}, 0.05}}};
  const Limb limb(joints);
  for (const auto& [centre, radius] : joints)
    EXPECT_LE(distance_to(limb, centre + Vec3d{0, 0, radius}), 1e-15);
  EXPECT_NEAR(distance_to(limb, {-1, 0, 0}), 0.9, 1e-15);
  EXPECT_NEAR(distance_to(limb, {0.5, 0, 1}), 0.8, 0.01);
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const Vec3d p = 2.0 * random_point(random);
    EXPECT_GE(distance_to(limb, p), std::min(0.0, distance_to(limb.box, p)) - 0.2);
    if (distance_to(limb.box, p) > 0) {
      EXPECT_GE(distance_to(limb, p), distance_to(limb.box, p) - 1e-15);
    }
  }
}

TEST(Field, ProjectionsLandOnSurfaceAndCurve) {
  const Field ball = [](Vec3d p) { return length(p) - 1; };
  const Field plane = [](Vec3d p) { return p.y + 0.5 * p.x - 0.2; };
  Random random(4);
  for (int i = 0; i < 50; ++i) {
    const Vec3d near = (1 + 0.2 * random.uniform(-1, 1)) * normalized(random_point(random));
    EXPECT_NEAR(ball(project_to_surface(ball, near)), 0, 1e-9);
    EXPECT_NEAR(length(cross(project_to_surface(ball, near), near)), 0, 1e-6) << "straight down";
    if (std::abs(plane(near)) > 0.3) continue;
    const Vec3d on_both = project_to_curve(ball, plane, near);
    EXPECT_NEAR(ball(on_both), 0, 1e-9);
    EXPECT_NEAR(plane(on_both), 0, 1e-9);
  }
}

TEST(Field, SectionsHaveTheirWidthsAndDepthsAtTheirHeights) {
  const std::array sections{Section{0, 0.2, 0.1, -0.1}, Section{0.5, 0.3, 0.2, -0.1},
                            Section{1, 0.1, 0.1, -0.1}};
  for (const Section& s : sections) {
    EXPECT_NEAR(distance_to_sections(sections, {0, s.height, s.front}), 0, 1e-15);
    EXPECT_NEAR(distance_to_sections(sections, {0, s.height, s.back}), 0, 1e-15);
    EXPECT_NEAR(distance_to_sections(sections, {-s.half_width, s.height, 0.5 * (s.front + s.back)}),
                0, 1e-15);
  }
  EXPECT_LT(distance_to_sections(sections, {0.21, 0.25, 0.02}), 0);
  EXPECT_NEAR(distance_to_sections(sections, {0.1, 7, 0}), 0, 1e-15) << "the end goes on";
}

}  // namespace
}  // namespace weft
