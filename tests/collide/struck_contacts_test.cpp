#include "weft/collide/filter/struck_contacts.h"

#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "tests/collide/test_bodies.h"

namespace weft::struck_contacts_test {
namespace {

using test::pyramid;
using test::TestCloth;

constexpr int n = 5, above = 2 * n + 2, below = n + 2;
constexpr double thickness = 0.004;

constexpr double step = 1.0 / 240;

/// A plane that held a sample above another.
SeparatingPlane between_samples() {
  SeparatingPlane plane;
  plane.normal = plane.turned = {0, 1, 0};
  plane.points = {above, below};
  plane.weights = {1, 1};
  plane.count_a = plane.count_b = 1;
  return plane;
}

/// The same plane as a search from the lower side finds it.
SeparatingPlane from_below() {
  SeparatingPlane plane = between_samples();
  plane.normal = plane.turned = {0, -1, 0};
  plane.points = {below, above};
  return plane;
}

/// A plane that held a sample above a body, which moved 3 cm up.
SeparatingPlane before_body() {
  SeparatingPlane plane = between_samples();
  plane.count_b = 0;
  plane.body = 0;
  plane.body_point_displacement = {0, 0.03, 0};
  return plane;
}

Obstacles one_body() {
  Obstacles obstacles;
  obstacles.bodies.push_back(test::octahedral_sphere(9, 0.1, {0, -0.1, 0}));
  return obstacles;
}

/// Two samples of a sheet, one 2 mm above the other.
class HeldApart {
 public:
  HeldApart() {
    cloth_.place([](int r, int c) { return Vec3d{0.1 * c, r == 2 ? 0.002 : 0, 0.1 * r}; });
    ThreadTeam team(1);
    world_.place_bodies(team);
  }
  /// What the next step knows of a step in which planes held back points and both went somewhere.
  std::span<const StruckContact> kept(Vec3f upper_way, Vec3f lower_way,
                                      std::vector<SeparatingPlane> planes = {between_samples()}) {
    cloth_.position.set(above, cloth_.start.at(above) + upper_way);
    cloth_.position.set(below, cloth_.start.at(below) + lower_way);
    const MovingCloth moving = cloth_.moving();
    contacts_.keep(planes, std::span(&moving, 1), step);
    contacts_.commit();
    return contacts_.found();
  }

  /// What is known after a run that had kept these.
  std::span<const StruckContact> restored(std::vector<StruckContact> kept) {
    contacts_.restore(kept);
    return contacts_.found();
  }

 private:
  TestCloth cloth_{n};
  BorderMates none_;
  CollidingCloth properties_{.mates = none_,
                             .size = n,
                             .thickness = thickness,
                             .rest_spacing = 0.1,
                             .self_collision = true,
                             .self_thickness = thickness};
  Obstacles obstacles_ = one_body();
  CollisionWorld world_{pyramid, obstacles_, std::span(&properties_, 1)};
  StruckContacts contacts_{world_};
};

TEST(StruckContacts, TheNextStepHoldsApartWhatRests) {
  HeldApart samples;
  const std::span<const StruckContact> kept = samples.kept({}, {});
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_FLOAT_EQ(kept[0].shared.contact.offset, 0.002F) << "no farther than it found them";
  const Contact& contact = kept[0].shared.contact;
  const int first = contact.weights[0] > 0 ? contact.samples[0] : contact.samples[1];
  EXPECT_EQ(contact.normal, (Vec3f{0, first == above ? 1.0F : -1.0F, 0}));
}

TEST(StruckContacts, WhatWasFoundFromBothSidesIsOneContact) {
  HeldApart samples;
  EXPECT_EQ(samples.kept({}, {}, {between_samples(), from_below()}).size(), 1U);
}

TEST(StruckContacts, ABodyThatMovesIsTakenToMoveOn) {
  HeldApart samples;
  const std::span<const StruckContact> kept = samples.kept({0, 0.03F, 0}, {}, {before_body()});
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_FLOAT_EQ(kept[0].shared.contact.offset, 0.002F + 0.03F) << "where the body begins";
  EXPECT_FLOAT_EQ(kept[0].body_velocity.y, 0.03F * 240);
  EXPECT_TRUE(samples.kept({}, {}, {before_body()}).empty()) << "the body went its way";
}

/// An edge of a fold and one of a facet below it have a plane that lies across the body. Held apart
/// along that, cloth could not slide.
TEST(StruckContacts, BodiesPressAlongTheirNormals) {
  HeldApart samples;
  SeparatingPlane across = before_body();
  across.body_point_displacement = {};
  for (const Vec3d normal : {Vec3d{0.8, 0.6, 0}, Vec3d{1, 0, 0}, normalized(Vec3d{1, -0.2, 0})}) {
    across.normal = across.turned = normal;
    const std::span<const StruckContact> kept = samples.kept({}, {}, {across});
    ASSERT_EQ(kept.size(), 1U);
    EXPECT_NEAR(kept[0].shared.contact.normal.y, 1, 1e-3) << normal.x;
    EXPECT_NEAR(kept[0].shared.contact.offset, 0.002, 1e-5) << normal.x;
  }
  across.normal = across.turned = normalized(Vec3d{0.3, 1, 0});
  EXPECT_FLOAT_EQ(samples.kept({}, {}, {across})[0].shared.contact.normal.x,
                  static_cast<float>(across.normal.x));
}

TEST(StruckContacts, TheNextStepHoldsApartWhatMovesTogether) {
  HeldApart samples;
  EXPECT_EQ(samples.kept({0.05F, 0.02F, 0}, {0.05F, 0.02F, 0}).size(), 1U);
}

TEST(StruckContacts, TheNextStepLeavesWhatSlides) {
  HeldApart samples;
  EXPECT_EQ(samples.kept({2e-4F, 0, 0}, {}).size(), 1U);
  EXPECT_TRUE(samples.kept({8e-4F, 0, 0}, {}).empty());
}

TEST(StruckContacts, WhatSparesTheFilterTheWorkGoesOn) {
  HeldApart samples;
  samples.kept({}, {});
  const std::span<const StruckContact> again = samples.kept({}, {}, {});
  ASSERT_EQ(again.size(), 1U);
  EXPECT_FLOAT_EQ(again[0].shared.contact.offset, 0.002F);
  EXPECT_TRUE(samples.kept({0, 3e-4F, 0}, {}, {}).empty()) << "its sides came apart";
}

TEST(StruckContacts, WhatCreepsIsLeftInTheEnd) {
  HeldApart samples;
  EXPECT_EQ(samples.kept({1.5e-4F, 0, 0}, {}).size(), 1U);
  EXPECT_EQ(samples.kept({1.5e-4F, 0, 0}, {}, {}).size(), 1U);
  EXPECT_TRUE(samples.kept({1.5e-4F, 0, 0}, {}, {}).empty());
}

TEST(StruckContacts, ARunThatGoesOnLeavesWhatIsNotThere) {
  HeldApart samples;
  const std::span<const StruckContact> kept = samples.kept({}, {});
  const StruckContact good = kept[0];
  StruckContact of_no_body = good, of_no_sample = good, of_no_cloth = good, of_one_point = good;
  of_no_body.body = 1;
  of_no_sample.shared.contact.samples[1] = n * n;
  of_no_cloth.shared.second = 1;
  of_one_point.shared.contact.samples[1] = of_one_point.shared.contact.samples[0];
  EXPECT_EQ(samples.restored({of_no_body, of_no_sample, good, of_no_cloth, of_one_point}).size(),
            1U);
}

}  // namespace
}  // namespace weft::struck_contacts_test
