#include <gtest/gtest.h>

#include "tests/sim/falling_sheet.h"
#include "weft/simulation.h"

namespace weft {
namespace {

/// A sheet of 0.6 m that falls on its edge, a little turned, and crumples.
Scene sheet_on_its_edge(int size = 25) {
  Scene scene;
  scene.cloths = {testing::sheet(size, {0.0051, 0.4039, 0})};
  Placement& placement = scene.cloths[0].placement;
  placement.scale = {0.6, 0.6, 0.6};
  placement.rotate = {92.1, 0, 0.9};
  return scene;
}

/// 1e-6 J are 6 mm/s. Where contacts of folds come and go between steps, or are left out of them,
/// it trembles with 2e-5 J for ever.
TEST(Rest, CrumpledSheetComesToRest) {
  Simulation simulation(sheet_on_its_edge(), "scene", 1);
  double mean = 0;
  for (int frame = 1; frame <= 200; ++frame) {
    const double kinetic = simulation.advance().kinetic_energy;
    if (frame > 160) mean += kinetic / 40;
  }
  EXPECT_LT(mean, 1e-6);
}

/// A run that goes on from a saved state ends with the same bits, also where contacts go on that
/// the filter asked for.
TEST(Rest, CrumpledSheetGoesOnFromASavedState) {
  const Scene scene = sheet_on_its_edge(33);
  Simulation simulation(scene, "scene", 1);
  SimulationState state;
  while (state.struck.empty() && simulation.frame() < 100) {
    simulation.advance();
    simulation.save(state);
  }
  ASSERT_FALSE(state.struck.empty());
  Simulation other(scene, "scene", 1);
  other.restore(state);
  for (int frame = 0; frame < 5; ++frame) {
    simulation.advance();
    other.advance();
  }
  EXPECT_EQ(simulation.state_hash(), other.state_hash());
}

/// A sheet that falls by a centimetre.
Scene low_sheet() {
  Scene scene;
  scene.ground = 0.0;
  scene.cloths = {testing::sheet(9, {0, 0.012, 0})};
  return scene;
}

/// The first frame after which a simulation tells that it rests; 0: none of 60 was.
int frame_of_rest(const Scene& scene) {
  Simulation simulation(scene, "scene", 1);
  if (simulation.is_at_rest()) return -1;
  for (int frame = 1; frame <= 60; ++frame) {
    simulation.advance();
    if (simulation.is_at_rest()) return frame;
  }
  return 0;
}

TEST(Rest, IsToldOnceClothLiesStill) {
  const int frame = frame_of_rest(low_sheet());
  EXPECT_GT(frame, 2) << "it falls";
  EXPECT_LT(frame, 60);
}

TEST(Rest, IsNotToldWhereSomethingMovesCloth) {
  Scene blown = low_sheet();
  blown.wind = WindOptions{{0.1, 0, 0}};
  EXPECT_EQ(frame_of_rest(blown), 0);
}

}  // namespace
}  // namespace weft
