#include <gtest/gtest.h>

#include "tests/sim/falling_sheet.h"
#include "weft/simulation.h"

namespace weft {
namespace {

/// A sheet of 0.6 m that falls on its edge, a little turned and moved, and crumples.
Scene sheet_on_its_edge(int start) {
  Scene scene;
  scene.cloths = {testing::sheet(25, {0.0017 * start, 0.4 + 0.0013 * start, 0})};
  Placement& placement = scene.cloths[0].placement;
  placement.scale = {0.6, 0.6, 0.6};
  placement.rotate = {90 + 0.7 * start, 0, 0.3 * start};
  return scene;
}

/// Its mean kinetic energy in frames 161 to 200. [J]
double energy_at_rest(int start) {
  Simulation simulation(sheet_on_its_edge(start), "scene", 1);
  double sum = 0;
  for (int frame = 1; frame <= 200; ++frame) {
    const double kinetic = simulation.advance().kinetic_energy;
    if (frame > 160) sum += kinetic / 40;
  }
  return sum;
}

/// 1e-6 J are 6 mm/s. Where contacts of folds come and go between steps, or are left out of them,
/// it trembles with 2e-5 J for ever.
TEST(Rest, CrumpledSheetComesToRest) {
  for (const int start : {0, 3}) EXPECT_LT(energy_at_rest(start), 1e-6) << start;
}

}  // namespace
}  // namespace weft
