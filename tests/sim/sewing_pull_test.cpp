#include <utility>

#include <gtest/gtest.h>

#include "tests/support/patterns.h"
#include "weft/garment.h"
#include "weft/sim/sewing/sewing.h"

namespace weft {
namespace {

/// A garment where its pattern places it, at rest.
struct Placed {
  explicit Placed(const std::string& pattern)
      : garment(make_garment(parse_pattern(pattern, "pattern"), "pattern", 0.02)),
        state{Planes3(garment.flat.size()), Planes3(garment.flat.size())} {
    const int n = garment.flat.size();
    for (int s = 0; s < n * n; ++s)
      state.position.set(s, vec_cast<float>(garment.image.world_position(s / n, s % n)));
  }
  /// The velocities that sewing gives it after it was moved.
  [[nodiscard]] Planes3 pulled(Vec3f moved, const std::vector<PastContact>& contacts) const {
    Sewing sewing(garment, state.position);
    ClothState now = state;
    for (int s = 0; s < now.position.size() * now.position.size(); ++s)
      now.position.set(s, now.position.at(s) + moved);
    sewing.pull({1.0 / 240, 0.1, contacts}, now);
    return now.velocity;
  }
  Garment garment;
  ClothState state;
};

TEST(SewingPull, LeavesOutWhatGoesIntoABody) {
  const Placed tube(test::tube_pattern(30, 20, 24, 100));
  const auto [a, b] = tube.garment.seams.front().pairs[3];
  const Vec3f towards = normalized(tube.state.position.at(b) - tube.state.position.at(a));
  EXPECT_GT(dot(tube.pulled({}, {}).at(a), towards), 0.1);
  PastContact against;
  against.samples = {a, -1, -1, -1};
  against.normal = -1.0F * towards;
  EXPECT_NEAR(dot(tube.pulled({}, {against}).at(a), towards), 0, 1e-3);
}

/// A corner that is not the first of its triangle, of either panel.
TEST(SewingPull, HeedsCornersOfTriangles) {
  const Placed tube(test::tube_pattern(30, 20, 24, 100));
  const auto [a, b] = tube.garment.seams.front().pairs[3];
  for (const auto& [one, other] : {std::pair{a, b}, std::pair{b, a}}) {
    const Vec3f towards = normalized(tube.state.position.at(other) - tube.state.position.at(one));
    PastContact against;
    against.samples = {-1, one, -1, -1};
    against.normal = -1.0F * towards;
    EXPECT_NEAR(dot(tube.pulled({}, {against}).at(one), towards), 0, 1e-3);
  }
}

TEST(SewingPull, HeedsBodiesOnly) {
  const Placed tube(test::tube_pattern(30, 20, 24, 100));
  const auto [a, b] = tube.garment.seams.front().pairs[3];
  const Vec3f towards = normalized(tube.state.position.at(b) - tube.state.position.at(a));
  // Of two panels, where their corners touch: no weight is on the rest of what touches.
  PastContact of_panels;
  of_panels.samples = {a, b, -1, -1};
  of_panels.normal = -1.0F * towards;
  EXPECT_GT(dot(tube.pulled({}, {of_panels}).at(a), towards), 0.1);
}

/// How a sample of a garment's first seam is pulled that a body with such a normal holds back.
Vec3f pulled_on_body(const Placed& placed, Vec3f beside, float against) {
  const auto [a, b] = placed.garment.seams.front().pairs[3];
  const Vec3f towards = normalized(placed.state.position.at(b) - placed.state.position.at(a));
  PastContact contact;
  contact.samples = {a, -1, -1, -1};
  contact.normal = normalized(beside - against * towards);
  return placed.pulled({}, {contact}).at(a);
}

TEST(SewingPull, GoesUpWhereTheGoalIsBehindABody) {
  const Placed cape(test::cape_pattern(30, 20, 24, 100));
  const Vec3f up = pulled_on_body(cape, {}, 1);
  EXPECT_GT(up.y, 0.1);
  EXPECT_NEAR(length(up), up.y, 1e-3);
  // A body that only grazes the way leaves it.
  EXPECT_NEAR(pulled_on_body(cape, {1, 0, 0}, 0.3F).y, 0, 1e-3);
}

/// They would draw their panels up with them.
TEST(SewingPull, SidesDoNotGoUpOnBodies) {
  const Placed tube(test::tube_pattern(30, 20, 24, 100));
  EXPECT_NEAR(length(pulled_on_body(tube, {}, 1)), 0, 1e-3);
}

/// Two samples of a seam that lie on a body, a millimetre apart, and are pressed into it.
TEST(SewingPull, PutsSamplesTogetherOnABodyAndNotInIt) {
  Placed tube(test::tube_pattern(30, 20, 24, 100));
  const auto [a, b] = tube.garment.seams.front().pairs[3];
  const Vec3f start = tube.state.position.at(a), out = normalized(Vec3f{0.2F, 0.1F, 1}),
              aside = normalized(cross(out, Vec3f{0, 1, 0}));
  Sewing sewing(tube.garment, tube.state.position);
  ClothState now = tube.state;
  now.position.set(b, start + 1e-3F * aside);
  PastContact on_body;
  on_body.samples = {a, -1, -1, -1};
  on_body.normal = out;
  sewing.pull({1.0 / 240, 10, std::span(&on_body, 1)}, now);
  now.position.set(a, start + 2e-3F * aside - 5e-4F * out);
  now.position.set(b, start + 3e-3F * aside - 5e-4F * out);
  sewing.close(now);
  EXPECT_EQ(now.position.at(a), now.position.at(b));
  EXPECT_NEAR(dot(now.position.at(a) - start, out), 0, 1e-6);
  EXPECT_NEAR(dot(now.position.at(a) - start, aside), 2.5e-3, 1e-6);
}

TEST(SewingPull, KeepsPanelsWithALabelAtTheirHeight) {
  const Placed free(test::tube_pattern(30, 20, 24, 100));
  const Placed held(test::tube_pattern(30, 20, 24, 100, "lower_interface"));
  const int sample = free.garment.seams.front().pairs[3][0];
  EXPECT_NEAR(free.pulled({0, -0.02F, 0}, {}).at(sample).y, 0, 1e-4);
  EXPECT_GT(held.pulled({0, -0.02F, 0}, {}).at(sample).y, 0.1);
  // They may rise.
  EXPECT_NEAR(held.pulled({0, 0.02F, 0}, {}).at(sample).y, 0, 1e-4);
}

TEST(SewingPull, SkirtsComeToTops) {
  const auto rise_of_seam = [](const std::string& top, const std::string& skirt) {
    const Placed placed(test::top_and_skirt(top, skirt));
    const auto [a, b] = placed.garment.seams.front().pairs[3];
    const Planes3 velocity = placed.pulled({}, {});
    return std::array<float, 2>{velocity.at(a).y, velocity.at(b).y};
  };
  const auto [top, skirt] = rise_of_seam("left_collar", "lower_interface");
  EXPECT_NEAR(top, 0, 1e-4);
  EXPECT_GT(skirt, 0.1);
  const auto [upper, lower] = rise_of_seam("", "");
  EXPECT_LT(upper, -0.05);
  EXPECT_NEAR(upper, -lower, 1e-3);
}

}  // namespace
}  // namespace weft
