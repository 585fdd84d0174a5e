#include <gtest/gtest.h>

#include "tests/support/patterns.h"
#include "weft/garment.h"
#include "weft/sim/stepping/sewing.h"

namespace weft {
namespace {

TEST(SewingPull, LeavesOutWhatGoesIntoABody) {
  const Garment garment =
      make_garment(parse_pattern(test::tube_pattern(30, 20, 24, 100), "tube"), "tube", 0.02);
  const int n = garment.flat.size();
  ClothState start{Planes3(n), Planes3(n)};
  for (int s = 0; s < n * n; ++s)
    start.position.set(s, vec_cast<float>(garment.image.world_position(s / n, s % n)));
  const auto [a, b] = garment.seams.front().pairs[3];
  const auto velocity_with = [&](const std::vector<PastContact>& contacts) {
    Sewing sewing(garment, start.position);
    ClothState state = start;
    sewing.pull({1.0 / 240, 0.1, contacts}, state);
    return state.velocity.at(a);
  };
  const Vec3f towards = normalized(start.position.at(b) - start.position.at(a));
  EXPECT_GT(dot(velocity_with({}), towards), 0.1);
  PastContact against;
  against.samples = {a, -1, -1, -1};
  against.normal = -1.0F * towards;
  EXPECT_NEAR(dot(velocity_with({against}), towards), 0, 1e-3);
}

}  // namespace
}  // namespace weft
