// Garments over each other.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tests/support/tube_scene.h"
#include "weft/simulation.h"

namespace weft::layers_test {
namespace {

/// Two tubes, the second wider, whose panels the patterns place in the same planes.
class Layers : public ::testing::Test {
 protected:
  Layers() {
    scene_.ground.reset();
    scene_.cloths = {test::tube_cloth(folder_ / "tube0.json", 30, 16, 0.03),
                     test::tube_cloth(folder_ / "tube1.json", 34, 16, 0.03)};
    scene_.bodies = {test::ball_in_tube(1.08)};
  }
  test::TemporaryFolder folder_;
  Scene scene_;
};

double largest_depth(const Simulation& simulation, std::size_t cloth) {
  double max = 0;
  const Planes3& p = simulation.cloths()[cloth].state.position;
  for (int s = 0; s < p.size() * p.size(); ++s) max = std::max(max, std::abs(double{p.at(s).z}));
  return max;
}

TEST_F(Layers, StartOutsideOfEachOtherInTheOrderOfTheScene) {
  const Simulation by_order(scene_, "scene", 1);
  EXPECT_NEAR(largest_depth(by_order, 0), 0.12, 1e-5);
  EXPECT_NEAR(largest_depth(by_order, 1), 0.17, 1e-5);
  scene_.cloths[0].layer = 2;
  scene_.cloths[1].layer = 0;
  const Simulation by_number(scene_, "scene", 1);
  EXPECT_NEAR(largest_depth(by_number, 0), 0.22, 1e-5);
  EXPECT_NEAR(largest_depth(by_number, 1), 0.12, 1e-5);
}

TEST_F(Layers, StartOutsideOfWhatOtherPatternsPlaceFartherOut) {
  const auto outer_begins_at = [&](double low) {
    write_file(scene_.cloths[1].surface.name, [&](std::ostream& out) {
      out << test::tube_pattern(34, 16, 14, low);  // panels 7 cm from the middle, below them 12
    });
    return largest_depth(Simulation(scene_, "scene", 1), 1);
  };
  EXPECT_NEAR(outer_begins_at(100), 0.12 + 0.05, 1e-5);
  EXPECT_NEAR(outer_begins_at(140), 0.07 + 0.05, 1e-5) << "above the other";
}

TEST_F(Layers, AreSewnOverEachOther) {
  Simulation simulation(scene_, "scene", 1);
  FrameReport report;
  int frame = 0;
  for (report.seam_gap = 1; report.seam_gap > 0 && frame < 150; ++frame) {
    report = simulation.advance();
    EXPECT_EQ(simulation.intersections().cloths, 0) << frame;
  }
  EXPECT_EQ(report.seam_gap, 0);
  for (const std::size_t cloth : {0, 1})
    for (const double gap : simulation.seam_gaps(cloth)) EXPECT_EQ(gap, 0);
}

}  // namespace
}  // namespace weft::layers_test
