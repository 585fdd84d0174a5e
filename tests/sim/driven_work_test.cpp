#include "weft/sim/stepping/driven_work.h"

#include <array>

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"

namespace weft {
namespace {

using namespace testing;

/// A sheet at rest, of which one sample is touched by a body that goes up by a centimetre and
/// aside by as much.
class Touched {
 public:
  Touched() {
    contact_.samples[0] = sample;
    contact_.normal = {0, 1, 0};
    contact_.surface_displacement = {0.01F, 0.01F, 0};
    contact_.friction = 0.5F;
  }
  static constexpr int sample = 12;
  static constexpr double step = 0.01;
  /// @param gained  by the sample in the step [m/s]
  double work(Vec3f gained, std::span<const float> forces) {
    end_.velocity.set(sample, gained);
    return work_.measure({start_, end_, step}, {std::span(&contact_, 1), forces});
  }
  /// The body and another one, which presses from the other side and goes the same way along it.
  double work_between(Vec3f gained, std::span<const float> forces) {
    Contact other = contact_;
    other.normal = {0.1F, -0.995F, 0};
    contact_.surface_displacement = other.surface_displacement = {0.01F, 0, 0};
    const std::array both{contact_, other};
    end_.velocity.set(sample, gained);
    return work_.measure({start_, end_, step}, {both, forces});
  }
  [[nodiscard]] double mass() const { return double{cloth_.mass(2, 2)}; }

 private:
  Cloth cloth_ = sheet_cloth(5, Material{});
  ThreadTeam team_{1};
  DrivenWork work_{cloth_, {}, team_};
  ClothState start_ = rest_state(cloth_), end_ = rest_state(cloth_);
  Contact contact_;
};

TEST(DrivenWork, IsWhatABodyPressesWithThoughALayerHoldsAgainstIt) {
  Touched touched;
  const std::array force{5.0F};
  EXPECT_NEAR(touched.work({}, force), 5 * 0.01, 1e-6);
  EXPECT_NEAR(touched.work({}, {}), 0, 1e-6);
}

TEST(DrivenWork, IsWhatAFilterPushedWithWhereASolveToldOfLess) {
  Touched touched;
  const double pushed = touched.mass() * 2 / Touched::step;
  EXPECT_NEAR(touched.work({0, 2, 0}, {}), pushed * 0.01, 1e-6 * pushed);
  const std::array less{static_cast<float>(0.5 * pushed)};
  EXPECT_NEAR(touched.work({0, 2, 0}, less), pushed * 0.01, 1e-6 * pushed);
}

TEST(DrivenWork, OfABodyThatGoesAwayIsNoPull) {
  Touched touched;
  EXPECT_NEAR(touched.work({0, -2, 0}, {}), 0, 1e-6);
}

/// The sum of both normals, which nearly cancel, is no direction of what presses: a particle that
/// stays as fast as it was has no work done on it.
TEST(DrivenWork, BetweenTwoBodiesIsThatOfEach) {
  Touched touched;
  const std::array forces{500.0F, 500.0F};
  EXPECT_NEAR(touched.work_between({}, forces), 0, 0.01);
}

TEST(DrivenWork, AlongTheSurfaceIsFrictionsAtMost) {
  Touched touched;
  const double aside = touched.mass() * 2 / Touched::step;
  const std::array force{static_cast<float>(aside)};
  // Half of what presses, of what would have taken all of it.
  EXPECT_NEAR(touched.work({2, 0, 0}, force), aside * 0.01 + 0.5 * aside * 0.01, 1e-5 * aside);
}

}  // namespace
}  // namespace weft
