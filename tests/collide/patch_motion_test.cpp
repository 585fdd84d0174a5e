#include "weft/collide/broad_phase/patch_motion.h"

#include <cmath>

#include <gtest/gtest.h>

namespace weft {
namespace {

/// A surface of 13 x 13 cells: 4 x 4 patches.
class PatchMotionTest : public testing::Test {
 protected:
  static constexpr int n = 14, patches = 4;
  PatchMotionTest() {
    for (int s = 0; s < n * n; ++s) {
      const int row = s / n, col = s % n;
      start_.set(s, {0.1F * static_cast<float>(col), 0, 0.1F * static_cast<float>(row)});
      end_.set(s, start_.at(s));
    }
    measure();
    motion_.renew(surface(), limit, 1);
  }
  [[nodiscard]] MovingSurface surface() const { return {&grid_, &start_, &end_}; }
  void measure() {
    Worker alone = Worker::lone();
    motion_.measure(surface(), alone);
  }
  static constexpr float limit = 0.01F;
  SurfaceGrid grid_{n, BorderMates(), {}};
  Planes3 start_{n}, end_{n};
  PatchMotion motion_{n - 1};
};

TEST_F(PatchMotionTest, IsRenewedWholeAtFirst) {
  EXPECT_EQ(motion_.versions().patches(), patches);
  for (int patch = 0; patch < patches * patches; ++patch) {
    EXPECT_EQ(motion_.versions().of(patch), 1);
    EXPECT_EQ(motion_.distance(patch), 0);
  }
}

TEST_F(PatchMotionTest, ASampleMovesThePatchesItIsACornerOf) {
  end_.set(4, 4, end_.at(4, 4) + Vec3f{0, 0.003F, 0.004F});
  measure();
  for (int patch = 0; patch < patches * patches; ++patch) {
    const bool touches = patch / patches <= 1 && patch % patches <= 1;  // samples 0 to 4 and 4 to 8
    EXPECT_NEAR(motion_.distance(patch), touches ? 0.005F : 0.0F, 1e-8F) << patch;
  }
}

TEST_F(PatchMotionTest, OnlyWhatWentFarIsRenewed) {
  start_.set(13, 13, start_.at(13, 13) + Vec3f{0.02F, 0, 0});
  end_.set(0, 0, end_.at(0, 0) + Vec3f{0.004F, 0, 0});
  measure();
  motion_.renew(surface(), limit, 7);
  for (int patch = 0; patch < patches * patches; ++patch) {
    const bool beside = patch / patches >= 2 && patch % patches >= 2;
    EXPECT_EQ(motion_.versions().of(patch), beside ? 7 : 1) << patch;
  }
  EXPECT_EQ(motion_.versions().latest(), 7);
  EXPECT_EQ(motion_.versions().of(Node{3, 0, 1}), 1);
  EXPECT_EQ(motion_.versions().of(Node{3, 1, 1}), 7);
  measure();
  EXPECT_EQ(motion_.distance(15), 0);
  EXPECT_NEAR(motion_.distance(0), 0.004F, 1e-8F) << "which rests where it was";
}

TEST_F(PatchMotionTest, WhatIsNotFiniteIsRenewed) {
  end_.set(5, 5, {HUGE_VALF, 0, 0});
  measure();
  motion_.renew(surface(), limit, 2);
  EXPECT_EQ(motion_.versions().of(5), 2);
  EXPECT_EQ(motion_.versions().of(2), 1);
}

TEST_F(PatchMotionTest, WhatIsForgottenIsRenewedWhole) {
  motion_.forget();
  measure();
  motion_.renew(surface(), limit, 3);
  for (int patch = 0; patch < patches * patches; ++patch)
    EXPECT_EQ(motion_.versions().of(patch), 3);
}

}  // namespace
}  // namespace weft
