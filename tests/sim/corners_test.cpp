#include <algorithm>

#include <gtest/gtest.h>

#include "weft/simulation.h"

namespace weft {
namespace {

Scene sheet_above(const std::string& body, Vec3d translate) {
  Scene scene;
  SceneCloth cloth;
  cloth.name = "sheet";
  cloth.surface = "builtin:sheet";
  cloth.size = 33;
  cloth.placement.translate = translate;
  scene.cloths = {cloth};
  SceneBody spike;
  spike.name = "body";
  spike.surface = "builtin:" + body;
  spike.size = 65;
  scene.bodies = {spike};
  return scene;
}

TEST(Corners, ATipBetweenSamplesCarriesASheetWithoutTearingASingleTriangle) {
  // 31 mm from sample to sample; the tip is under the inside of a triangle.
  Simulation simulation(sheet_above("cone", {0.02, 0.31, 0.012}), "s.json", 2);
  double worst = 0;
  for (int frame = 0; frame < 24; ++frame) worst = std::max(worst, simulation.advance().strain.max);
  EXPECT_LT(worst, 0.12);
  // It hangs there.
  EXPECT_GT(simulation.centre_of_mass().y, 0);
}

TEST(Corners, AMovingTipEndsARunThatWasTakenUpInTheSameBits) {
  Scene scene = sheet_above("cone", {0.02, 0.305, 0.012});
  scene.bodies[0].motion = {{0, {}, {}}, {0.3, {5, 20, 5}, {0.03, 0.01, 0}}};
  Simulation through(scene, "s.json", 2), again(scene, "s.json", 3);
  for (int frame = 0; frame < 6; ++frame) through.advance();
  SimulationState state;
  through.save(state);
  again.restore(state);
  int contacts = 0;
  for (int frame = 0; frame < 6; ++frame) {
    through.advance();
    contacts = std::max(contacts, again.advance().contacts);
  }
  EXPECT_GT(contacts, 0);
  EXPECT_EQ(again.state_hash(), through.state_hash());
}

}  // namespace
}  // namespace weft
