#include <gtest/gtest.h>

#include "weft/simulation.h"

namespace weft {
namespace {

constexpr int settle_frames = 60, carried_frames = 30;

/// A sheet on a ball that begins to move sideways after half a second, at 0.3 m/s.
Scene carrying_ball() {
  Scene scene;
  SceneCloth sheet;
  sheet.size = 33;
  sheet.placement.translate = {0, 0.56, 0};
  scene.cloths = {sheet};
  SceneBody ball;
  ball.surface = "builtin:sphere";
  ball.size = 65;
  ball.motion = {{0, {}, {}}, {0.5, {}, {}}, {2.5, {}, {0.6, 0, 0}}};
  scene.bodies = {ball};
  return scene;
}

TEST(Carried, AMovingBodyTakesItsClothAlongInFewIterations) {
  Simulation simulation(carrying_ball(), "carried", 1);
  for (int frame = 0; frame < settle_frames; ++frame) simulation.advance();
  const Vec3d cloth_before = simulation.centre_of_mass();
  const Vec3f ball_before = simulation.bodies()[0].positions.at(0);
  int iterations = 0;
  for (int frame = 0; frame < carried_frames; ++frame)
    iterations += simulation.advance().iterations;
  const double distance = simulation.centre_of_mass().x - cloth_before.x;
  const double wanted = simulation.bodies()[0].positions.at(0).x - ball_before.x;
  EXPECT_NEAR(distance, wanted, 0.01 * wanted);
  // Friction and the ball's work are known from the step before: nothing has to be found again.
  EXPECT_LT(iterations, 25 * carried_frames);
}

}  // namespace
}  // namespace weft
