#include <gtest/gtest.h>

#include "tests/sim/falling_sheet.h"
#include "weft/core/math.h"
#include "weft/simulation.h"

namespace weft {
namespace {

/// A stiff sheet of that side that falls on a ball beside its middle, and slips off.
Scene sheet_onto_ball(double side, int substeps) {
  Scene scene;
  scene.ground.reset();
  scene.substeps = substeps;
  scene.cloths = {testing::sheet(33, {0, 1.2 * side, 0})};
  SceneCloth& cloth = scene.cloths[0];
  cloth.placement.scale = {side, side, side};
  cloth.material = {.density = 0.1, .stretch = 14700, .bending = 1e-6, .thickness = 5e-4};
  SceneBody& ball = scene.bodies.emplace_back();
  ball.surface = "builtin:sphere";
  ball.placement.scale = {0.3 * side, 0.3 * side, 0.3 * side};
  ball.placement.translate = {0.1 * side, 0.8 * side, 0};
  return scene;
}

/// One linearisation a step makes it slip off late: it is 0.67 of its side away from there then.
TEST(Impact, SmallStiffClothSlipsOffABallWhenItDoesInShortSteps) {
  constexpr double side = 0.03;
  Simulation usual(sheet_onto_ball(side, 4), "usual", 2),
      fine(sheet_onto_ball(side, 32), "fine", 2);
  for (int frame = 0; frame < 12; ++frame) {
    const Vec3d off = usual.advance().centre_of_mass - fine.advance().centre_of_mass;
    EXPECT_LT(length(off), (frame < 10 ? 0.1 : 0.3) * side) << frame;
  }
}

}  // namespace
}  // namespace weft
