#include "weft/sim/stepping/driven_work.h"

#include <array>

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"

namespace weft {
namespace {

using namespace testing;

constexpr Vec3f up{0, 0.01F, 0}, aside{0.01F, 0, 0};

/// A sheet at rest without gravity, of which samples are touched by bodies, and others gain speed.
class Touched {
 public:
  static constexpr int n = 5;
  static constexpr double step = 0.01;
  /// A body that goes its way in the step. @param force  solved, along its normal [N]
  void touch(int sample, Vec3f way, Vec3f normal = {0, 1, 0}, float force = 0) {
    Contact contact;
    contact.samples[0] = sample;
    contact.normal = normal;
    contact.surface_displacement = way;
    contacts_.push_back(contact);
    forces_.push_back(force);
  }
  /// Speed that a sample gains by a force of 1 N through the step.
  void push(int sample, Vec3f along) {
    const auto gain = static_cast<float>(step / mass());
    end_.velocity.set(sample, end_.velocity.at(sample) + gain * along);
  }
  void pin(int sample, Vec3f way) {
    cloth_.pins.push_back({.sample = sample, .target = {}});
    cloth_.inverse_mass(sample / n, sample % n) = 0;
    end_.position.set(sample, end_.position.at(sample) + way);
  }
  double work(DrivenWork::Free free = {}) {
    DrivenWork work(cloth_, {}, team_);
    const DoneStep done{start_, end_, step};
    if (!work.begin(done, {contacts_, forces_})) return 0;
    while (work.ways().spread()) continue;
    return work.measure(done, free);
  }
  [[nodiscard]] double mass() const { return double{cloth_.mass(2, 2)}; }

 private:
  Cloth cloth_ = sheet_cloth(n, Material{});
  ThreadTeam team_{1};
  ClothState start_ = rest_state(cloth_), end_ = rest_state(cloth_);
  std::vector<Contact> contacts_;
  std::vector<float> forces_;
};

constexpr double newton_way = 0.01, close = 1e-6;  // [J]

TEST(DrivenWork, IsForceTimesTheWayOfTheBody) {
  Touched touched;
  touched.touch(12, up);
  touched.push(12, {1, 3, 0});
  EXPECT_NEAR(touched.work(), 3 * newton_way, close);
}

/// What a solve leaves on particles that nothing touches came from what is next to them.
TEST(DrivenWork, CountsWhatIsLeftOnFreeParticlesByTheNearestBody) {
  Touched touched;
  touched.touch(6, up);
  touched.touch(8, aside);
  touched.push(11, {5, 1, 0});   // below sample 6
  touched.push(13, {-2, 7, 0});  // below sample 8
  EXPECT_NEAR(touched.work(), (1 - 2) * newton_way, close);
  EXPECT_NEAR(touched.work({.any = false}), 0, close);
}

TEST(DrivenWork, IsNoneOfForcesBetweenParticlesThatOneBodyHolds) {
  Touched touched;
  touched.touch(12, up);
  touched.push(12, {0, 4, 0});
  touched.push(11, {0, -4, 0});
  EXPECT_NEAR(touched.work(), 0, close);
}

TEST(DrivenWork, IsNoneWhereWhatIsNearestStandsStill) {
  Touched touched;
  touched.touch(6, up);
  touched.touch(18, {});
  touched.push(23, {0, 4, 0});
  touched.push(18, {0, 4, 0});
  EXPECT_NEAR(touched.work(), 0, close);
}

/// Both press hard and nearly cancel: each works by its own way.
TEST(DrivenWork, BetweenTwoBodiesIsThatOfEach) {
  Touched touched;
  touched.touch(12, up, {0, 1, 0}, 500);
  touched.touch(12, {}, {0, -1, 0}, 500);
  EXPECT_NEAR(touched.work(), 500 * newton_way, close);
}

TEST(DrivenWork, OfPinsIsTheirForceTimesTheirWayAlsoWhereABodyTouchesThem) {
  Touched touched;
  touched.touch(12, up);
  touched.pin(12, {0.002F, 0, 0});
  touched.push(11, {3, 5, 0});
  // The pin draws at springs, too: what those do to its neighbours they undo to it.
  EXPECT_NEAR(touched.work(), 3 * 0.002, close);
}

/// Layers press on each other far from their pins, which go different ways.
TEST(DrivenWork, OfPinsThatMoveDifferentlyIsTheirOwnForceWhereLayersTouch) {
  for (const Vec3f other : {Vec3f{0, -0.002F, 0}, Vec3f{0.002F, 0, 0}}) {
    Touched touched;
    touched.pin(0, {0.002F, 0, 0});
    touched.pin(24, other);
    const double before = touched.work({.layered = true});
    touched.push(6, {3, 0, 0});
    EXPECT_NEAR(touched.work({.layered = true}) - before, other.x > 0 ? 3 * 0.002 : 0, close);
  }
}

}  // namespace
}  // namespace weft
