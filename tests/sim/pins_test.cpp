#include "weft/sim/motion/pins.h"

#include <algorithm>
#include <utility>

#include <gtest/gtest.h>

#include "weft/error.h"
#include "weft/geometry_image.h"
#include "weft/image/builtin.h"
#include "weft/sim/placement.h"

namespace weft {
namespace {

constexpr int held_size = 5;

/// A square of 1 m about the origin, or what else has an image.
Cloth cloth_of(const char* shape) {
  const GeometryImage image = make_image_shape(shape, held_size);
  return make_cloth(placed_positions(image, placement_map({{1, 1, 1}, {}, {}})), image.mates, {});
}

std::vector<int> samples_of(const Cloth& cloth, const std::vector<int>& pins) {
  std::vector<int> samples;
  for (const int pin : pins) samples.push_back(cloth.pins[static_cast<std::size_t>(pin)].sample);
  std::sort(samples.begin(), samples.end());
  return samples;
}

TEST(Pins, APlaceOfTheImageIsItsNearestSample) {
  EXPECT_EQ(sample_at(held_size, {0, 0}), 0);
  EXPECT_EQ(sample_at(held_size, {1, 0.5}), 2 * held_size + 4);
  EXPECT_EQ(sample_at(held_size, {0.3, 0.9}), 4 * held_size + 1);
}

TEST(Pins, APlaceInSpaceIsTheNearestSample) {
  Cloth cloth = cloth_of("sheet");
  const std::vector<int> held = pin_place(cloth, NearestPin{{0.1, 3, 0.3}});
  EXPECT_EQ(samples_of(cloth, held), std::vector{3 * held_size + 2});
}

TEST(Pins, ARegionHoldsTheSamplesOnItsEdgesToo) {
  Cloth cloth = cloth_of("sheet");
  const std::vector<int> held = pin_place(cloth, RegionPin{{0.25, 0}, {0.5, 0.25}});
  EXPECT_EQ(samples_of(cloth, held), (std::vector{1, 2, held_size + 1, held_size + 2}));
}

TEST(Pins, ARegionBetweenSamplesIsRefused) {
  Cloth cloth = cloth_of("sheet");
  EXPECT_THROW(pin_place(cloth, RegionPin{{0.3, 0.3}, {0.4, 0.4}}), SceneError);
}

TEST(Pins, MovedOnesTurnAboutTheirMiddle) {
  Cloth cloth = cloth_of("sheet");
  // Two corners, 1 m apart, turn by a quarter while they rise.
  const auto motions = pin_places(
      cloth,
      std::vector{ScenePin(RegionPin{{0, 0}, {1, 0}}, {{0, {}, {}}, {2, {0, 90, 0}, {0, 1, 0}}})});
  move_pins(motions, 2, cloth);
  for (const Pin& pin : cloth.pins) {
    const double along = double{cloth.rest.at(pin.sample).x};
    EXPECT_LT(length(pin.target - Vec3d{0, 1, -0.5 - along}), 1e-6);
  }
}

TEST(Pins, TheFastestIsTheOneFarthestFromTheAxis) {
  Cloth cloth = cloth_of("sheet");
  const auto motions = pin_places(
      cloth, std::vector{ScenePin(RegionPin{{0, 0}, {1, 0}}, {{0, {}, {}}, {1, {0, 60, 0}, {}}})});
  EXPECT_NEAR(fastest_pin(motions), 0.5 * 60 / 57.29578, 1e-3);
}

TEST(Pins, WhatIsLetGoMovesNoMore) {
  Cloth cloth = cloth_of("sheet");
  auto motions = pin_places(
      cloth, std::vector{ScenePin(RegionPin{{0, 0}, {1, 0}}, {{0, {}, {}}, {1, {}, {0, 1, 0}}})});
  const std::vector<int> first{motions[0].pins[0]};
  const Vec3d before = cloth.pins[static_cast<std::size_t>(first[0])].target;
  let_go(first, motions);
  move_pins(motions, 1, cloth);
  EXPECT_EQ(cloth.pins[static_cast<std::size_t>(first[0])].target, before);
  EXPECT_NEAR(cloth.pins[static_cast<std::size_t>(motions[0].pins[0])].target.y, before.y + 1,
              1e-9);
}

TEST(Pins, BesideACornerOfASheetAreTwoSamples) {
  Cloth cloth = cloth_of("sheet");
  const std::vector<int> held = pin_place(cloth, ImagePin{{0, 0}});
  std::vector<int> beside;
  for_each_beside(cloth, cloth.pins[static_cast<std::size_t>(held[0])],
                  [&](int, int r, int c) { beside.push_back(r * held_size + c); });
  EXPECT_EQ(beside, (std::vector{held_size, 1}));
}

TEST(Pins, BesideACornerOfATorusAreTwoSamplesOfEachCopy) {
  Cloth cloth = cloth_of("torus");
  const std::vector<int> held = pin_place(cloth, ImagePin{{0, 0}});
  std::vector<std::pair<int, int>> beside;
  for_each_beside(cloth, cloth.pins[static_cast<std::size_t>(held[0])],
                  [&](int copy, int r, int c) { beside.emplace_back(copy, r * held_size + c); });
  EXPECT_EQ(beside.size(), 8U);
  EXPECT_EQ(std::count_if(beside.begin(), beside.end(), [](auto p) { return p.first == 0; }), 2);
}

}  // namespace
}  // namespace weft
