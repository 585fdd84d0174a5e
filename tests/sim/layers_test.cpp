// Garments over each other.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/patterns.h"
#include "tests/support/temporary_folder.h"
#include "weft/files.h"
#include "weft/simulation.h"

namespace weft {
namespace {

/// Two tubes, the second wider, whose panels the patterns place in the same planes.
class Layers : public testing::Test {
 protected:
  Layers() {
    scene_.ground.reset();
    for (const double width : {30.0, 34.0}) {
      const std::string path = (folder_ / (std::to_string(width) + ".json")).string();
      write_file(path, [&](std::ostream& out) { out << test::tube_pattern(width, 16, 24, 100); });
      SceneCloth cloth;
      cloth.name = "tube" + std::to_string(scene_.cloths.size());
      cloth.surface = path;
      cloth.spacing = 0.03;
      scene_.cloths.push_back(cloth);
    }
    SceneBody body;
    body.surface = "builtin:sphere";
    body.size = 33;
    body.placement.scale = {0.15, 0.15, 0.15};
    body.placement.translate = {0, 1.08, 0};
    scene_.bodies.push_back(body);
  }
  test::TemporaryFolder folder_;
  Scene scene_;
};

double largest_depth(const Simulation& simulation, std::size_t cloth) {
  double most = 0;
  const Planes3& p = simulation.cloths()[cloth].state.position;
  for (int s = 0; s < p.size() * p.size(); ++s) most = std::max(most, std::abs(double{p.at(s).z}));
  return most;
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
}  // namespace weft
