#include "weft/collide/baselines/depth_image.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

constexpr Box3f window{{0, 0, 0}, {1, 1, 1}};
const auto none = [](int /*block*/) { return false; };

Box3f box_at(Vec3f centre, float half) {
  const Vec3f aside{half, half, half};
  return {centre - aside, centre + aside};
}

TEST(DepthImage, TellsWhatLiesBeforeAllFromEverySide) {
  for (int v = 0; v < view_count; ++v) {
    const ViewDirection view = view_direction(v);
    DepthImage<1> image;
    image.clear(window, view);
    image.draw(box_at({0.5F, 0.5F, 0.5F}, 0.05F), 0);
    Vec3f towards;
    (view.axis == 0   ? towards.x
     : view.axis == 1 ? towards.y
                      : towards.z) = view.backwards ? 0.3F : -0.3F;
    const Vec3f middle{0.5F, 0.5F, 0.5F};
    EXPECT_TRUE(image.is_before_all(box_at(middle + towards, 0.05F), 0, none)) << v;
    EXPECT_FALSE(image.is_before_all(box_at(middle - towards, 0.05F), 0, none)) << v;
    EXPECT_FALSE(image.is_before_all(box_at(middle + towards, 0.05F), 0.25F, none)) << v;
    // Beside it: nothing is drawn there.
    const Vec3f aside{towards.y, towards.z, towards.x};
    EXPECT_TRUE(image.is_before_all(box_at(middle - towards + aside, 0.05F), 0, none)) << v;
  }
}

TEST(DepthImage, KeepsTheNearestBlocksSoThatAnyButOneMayBeIgnored) {
  DepthImage<3> image;
  image.clear(window, view_direction(0));
  for (const int block : {4, 1, 3, 0, 2, 1})
    image.draw(box_at({0.1F + 0.2F * static_cast<float>(block), 0.5F, 0.5F}, 0.01F), block);
  const Box3f behind_two = box_at({0.6F, 0.5F, 0.5F}, 0.01F);
  EXPECT_FALSE(image.is_before_all(behind_two, 0, none));
  EXPECT_FALSE(image.is_before_all(behind_two, 0, [](int block) { return block < 2; }));
  EXPECT_TRUE(image.is_before_all(behind_two, 0, [](int block) { return block < 3; }));
}

TEST(DepthImage, MissesNothingThinnerThanAPixel) {
  DepthImage<1> image;
  image.clear(window, view_direction(4));
  for (int i = 0; i < 1000; ++i) {
    const float at = 0.001F * static_cast<float>(i);
    image.clear(window, view_direction(4));
    image.draw({{at, at, 0.5F}, {at, at, 0.5F}}, 0);
    EXPECT_FALSE(image.is_before_all({{at, at, 0.6F}, {at, at, 0.6F}}, 0, none)) << i;
  }
}

TEST(DepthImage, EndlessWindowsHideNothing) {
  DepthImage<1> image;
  image.clear({{-HUGE_VALF, 0, 0}, {HUGE_VALF, 1, 1}}, view_direction(4));
  image.draw(box_at({0.5F, 0.5F, 0.2F}, 0.1F), 0);
  EXPECT_FALSE(image.is_before_all(box_at({0.5F, 0.5F, 0.8F}, 0.1F), 0, none));
}

}  // namespace
}  // namespace weft
