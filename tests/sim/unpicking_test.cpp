#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/patterns.h"
#include "weft/garment.h"
#include "weft/sim/sewing/sewing.h"

namespace weft {
namespace {

constexpr double frame_time = 1.0 / 60;

/// A tube whose panels lie in one place, so that its seams are closed, but for one pair of the
/// first, which is this far apart. [m]
struct ClosedTube {
  /// @param stretched  how many times as wide as it was cut
  explicit ClosedTube(double gap, float stretched = 1)
      : garment(make_garment(parse_pattern(test::tube_pattern(30, 20, 24, 100), "pattern"),
                             "pattern", 0.01)),
        state{Planes3(garment.flat.size()), Planes3(garment.flat.size())} {
    const int n = garment.flat.size();
    for (int s = 0; s < n * n; ++s) {
      const auto place = vec_cast<float>(garment.image.world_position(s / n, s % n));
      state.position.set(s, {stretched * place.x, place.y, 0});
    }
    const auto [a, b] = seam()[open];
    state.position.set(a, state.position.at(a) + Vec3f{0, 0, static_cast<float>(gap)});
  }
  [[nodiscard]] const std::vector<std::array<int, 2>>& seam() const {
    return garment.seams.front().pairs;
  }
  /// How many samples of the first seam are joined to others in a frame.
  [[nodiscard]] int joined(const Sewing& sewing) const {
    const BorderMates mates = sewing.joined(state.position);
    return static_cast<int>(
        std::count_if(seam().begin(), seam().end(), [&](const std::array<int, 2>& pair) {
          return mates.representative(pair[0]) == mates.representative(pair[1]);
        }));
  }
  static constexpr int open = 9;
  Garment garment;
  ClothState state;
};

/// The frames of ten seconds in which something is taken apart.
std::vector<int> frames_of_unpicking(const ClosedTube& tube) {
  // Begun where the pattern places it, as its distances tell when seams should have closed.
  Sewing sewing(tube.garment, ClosedTube(0).state.position);
  const auto all = static_cast<int>(tube.seam().size());
  std::vector<int> frames;
  for (int frame = 0; frame < 600; ++frame) {
    sewing.begin_frame(tube.state.position, frame * frame_time, frame_time);
    const int apart = all - tube.joined(sewing);
    if (apart > 1) {
      EXPECT_EQ(apart, 7);
      frames.push_back(frame);
    }
  }
  return frames;
}

TEST(Unpicking, TakesASeamApartNextToWhatIsStuck) {
  const std::vector<int> frames = frames_of_unpicking(ClosedTube(0.008));
  ASSERT_EQ(frames.size(), 12U);
  EXPECT_LT(frames.front(), 60);
  for (std::size_t i = 1; i < frames.size(); ++i) EXPECT_GE(frames[i] - frames[i - 1], 20);
}

/// What is so near has been put together in every step, and something held it apart.
TEST(Unpicking, TakesApartWhatHasNearlyMet) {
  EXPECT_EQ(frames_of_unpicking(ClosedTube(0.0003)).size(), 12U);
}

TEST(Unpicking, LeavesAloneWhatIsClosedOrFarApart) {
  EXPECT_TRUE(frames_of_unpicking(ClosedTube(0)).empty());
  EXPECT_TRUE(frames_of_unpicking(ClosedTube(0.1)).empty());
}

TEST(Unpicking, LeavesAloneWhatIsMuchTooNarrow) {
  EXPECT_FALSE(frames_of_unpicking(ClosedTube(0.008, 1.3F)).empty());
  EXPECT_TRUE(frames_of_unpicking(ClosedTube(0.008, 1.45F)).empty());
}

/// How far apart the pair is when what is near each other is closed in a step. [m]
double gap_after_closing(ClosedTube tube, double seconds) {
  Sewing sewing(tube.garment, ClosedTube(0).state.position);
  ClothState state = tube.state;
  sewing.pull({frame_time / 4, seconds, {}}, state);
  state.position = tube.state.position;
  sewing.close(state);
  const auto [a, b] = tube.seam()[ClosedTube::open];
  return double{length(state.position.at(b) - state.position.at(a))};
}

TEST(SewingClose, JoinsWhatIsNearOnceSeamsShouldHaveClosed) {
  EXPECT_EQ(gap_after_closing(ClosedTube(0.003), 2), 0);
  EXPECT_NEAR(gap_after_closing(ClosedTube(0.005), 2), 0.005, 1e-6);
  EXPECT_NEAR(gap_after_closing(ClosedTube(0.003), 0.05), 0.003, 1e-6);
  EXPECT_EQ(gap_after_closing(ClosedTube(0.00005), 0.05), 0);
}

TEST(Unpicking, EdgesGoBackIntoTheirPanels) {
  ClosedTube tube(0.008);
  const int frame = frames_of_unpicking(tube).front();
  Sewing sewing(tube.garment, ClosedTube(0).state.position);
  sewing.begin_frame(tube.state.position, frame * frame_time, frame_time);
  sewing.pull({frame_time / 4, frame * frame_time, {}}, tube.state);
  const double spacing = 0.01;
  for (int k = 0; k < static_cast<int>(tube.seam().size()); ++k) {
    const auto [a, b] = tube.seam()[k];
    const bool near = std::abs(k - ClosedTube::open) <= 3;
    for (const int s : {a, b}) {
      const Vec3f place = tube.state.position.at(s), velocity = tube.state.velocity.at(s);
      // The tube's middle is the y axis.
      const double inwards = -velocity.x * (place.x > 0 ? 1 : -1) * frame_time;
      if (near)
        EXPECT_GT(inwards, spacing / 2) << k;
      else
        EXPECT_NEAR(inwards, 0, spacing / 20) << k;
    }
  }
}

}  // namespace
}  // namespace weft
