#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/sim/falling_sheet.h"
#include "weft/simulation.h"

namespace weft {
namespace {

using testing::sheet;

/// A plate of 10 cm that hardly bends, held by a row, or by two on opposite sides.
Scene plate(int size, double bending, const std::vector<RegionPin>& rows) {
  Scene scene;
  scene.ground.reset();
  scene.cloths = {sheet(size, {})};
  scene.cloths[0].placement.scale = {0.1, 0.1, 0.1};
  scene.cloths[0].material.bending = bending;
  scene.cloths[0].material.density = 0.1;
  scene.cloths[0].material.damping = 0;
  for (const RegionPin& row : rows) scene.cloths[0].pins.push_back({row, {}});
  return scene;
}

constexpr RegionPin left{{0, 0}, {0, 1}}, right{{1, 0}, {1, 1}};

/// A rigid plate falls about its edge as a pendulum does: with 3 g / 2 L at the start.
TEST(StiffPlates, SwingAboutTheRowThatHoldsThem) {
  for (const int size : {17, 33, 40, 49})
    for (const double bending : {1e-3, 0.1, 3.}) {
      Simulation simulation(plate(size, bending, {left}), "plate", 1);
      simulation.advance();
      const FrameReport report = simulation.advance();
      constexpr double h = 1.0 / 240, length = 0.1, steps = 8;
      const double angle = 1.5 * 9.81 / length * h * h * steps * (steps + 1) / 2;
      EXPECT_NEAR(report.centre_of_mass.y, -length / 2 * std::sin(angle), 4e-4)
          << size << ", " << bending;
    }
}

/// Between two hinges it sags by 5 q L^4 / (384 B), see a beam's formula.
TEST(StiffPlates, StayBetweenTwoRowsThatHoldThem) {
  for (const int size : {17, 33, 40, 49})
    for (const double bending : {1e-3, 0.1, 3.}) {
      Simulation simulation(plate(size, bending, {left, right}), "plate", 1);
      double least = 0;
      for (int frame = 0; frame < 6; ++frame)
        least = std::min(least, simulation.advance().centre_of_mass.y);
      // The middle of a beam sags by 1.6 times its mean, and swings twice as far.
      const double sag = 5 * 0.1 * 9.81 * 1e-4 / (384 * bending);
      EXPECT_GT(least, -2.2 * sag / 1.6 - 2e-5) << size << ", " << bending;
    }
}

}  // namespace
}  // namespace weft
