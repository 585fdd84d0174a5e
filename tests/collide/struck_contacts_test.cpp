#include "weft/collide/filter/struck_contacts.h"

#include <gtest/gtest.h>

#include "tests/collide/test_bodies.h"

namespace weft {
namespace {

using test::pyramid;
using test::TestCloth;

constexpr int n = 5, above = 2 * n + 2, below = n + 2;
constexpr double thickness = 0.004;

/// Two samples of a sheet, one 2 mm above the other, between which a plane held points apart.
class HeldApart {
 public:
  HeldApart() {
    cloth_.place([](int r, int c) { return Vec3d{0.1 * c, r == 2 ? 0.002 : 0, 0.1 * r}; });
    plane_.normal = plane_.turned = {0, 1, 0};
    plane_.points = {above, below};
    plane_.weights = {1, 1};
    plane_.count_a = plane_.count_b = 1;
  }
  /// What the next step knows of a step in which both went somewhere.
  std::span<const StruckContact> kept(Vec3f upper_way, Vec3f lower_way) {
    cloth_.position.set(above, cloth_.start.at(above) + upper_way);
    cloth_.position.set(below, cloth_.start.at(below) + lower_way);
    const MovingCloth moving = cloth_.moving();
    contacts_.keep(std::span(&plane_, 1), std::span(&moving, 1));
    contacts_.commit();
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
  CollisionWorld world_{pyramid, {}, std::span(&properties_, 1)};
  StruckContacts contacts_{world_};
  SeparatingPlane plane_;
};

TEST(StruckContacts, TheNextStepHoldsApartWhatRests) {
  HeldApart samples;
  const std::span<const StruckContact> kept = samples.kept({}, {});
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_FLOAT_EQ(kept[0].shared.contact.offset, 0.002F) << "no farther than it found them";
  EXPECT_EQ(kept[0].shared.contact.normal, (Vec3f{0, 1, 0}));
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

}  // namespace
}  // namespace weft
