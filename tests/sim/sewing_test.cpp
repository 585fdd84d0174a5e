#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tests/support/tube_scene.h"
#include "weft/simulation.h"

namespace weft::sewing_test {
namespace {

/// A tube sewn round the built-in cylinder or ball.
class Sewing : public ::testing::Test {
 protected:
  Sewing() {
    scene_.ground.reset();
    scene_.cloths = {test::tube_cloth(folder_ / "tube.json", 30, 20, 0.02)};
    scene_.bodies = {test::ball_in_tube(1.1)};
  }
  test::TemporaryFolder folder_;
  Scene scene_;
};

TEST_F(Sewing, ClosesSeamsRoundABody) {
  Simulation simulation(scene_, "scene", 1);
  EXPECT_NEAR(simulation.seam_gaps(0).front(), 0.24, 1e-3);
  FrameReport report;
  int frame = 0;
  for (report.seam_gap = 1; report.seam_gap > 0 && frame < 150; ++frame)
    report = simulation.advance();
  EXPECT_EQ(report.seam_gap, 0) << "after " << frame << " frames";
  // Sewn, all samples of a class have the same bits.
  const SimulatedCloth& cloth = simulation.cloths()[0];
  for (const GarmentSeam& seam : cloth.garment->seams)
    for (const auto& [a, b] : seam.pairs)
      EXPECT_EQ(cloth.state.position.at(a), cloth.state.position.at(b));
  EXPECT_EQ(simulation.crossings(), 0);
}

TEST_F(Sewing, StretchesNothingOnTheWay) {
  scene_.bodies.clear();
  Simulation simulation(scene_, "scene", 1);
  double strain = 0;
  FrameReport report;
  for (report.seam_gap = 1; report.seam_gap > 0;) {
    report = simulation.advance();
    strain = std::max(strain, report.strain.max);
    ASSERT_LT(report.strain.p99, 0.02);
  }
  EXPECT_LT(strain, 0.05);
}

TEST_F(Sewing, ComesToTheSampleOfASeamThatAPinHolds) {
  scene_.bodies.clear();
  int held = 0;
  {
    const Simulation start(scene_, "scene", 1);
    held = start.cloths()[0].garment->seams.front().pairs.front()[1];
  }
  const int n = Simulation(scene_, "scene", 1).cloths()[0].model->size;
  scene_.cloths[0].pins = {
      ImagePin{{static_cast<double>(held % n) / (n - 1), static_cast<double>(held / n) / (n - 1)}}};
  Simulation simulation(scene_, "scene", 1);
  const SimulatedCloth& cloth = simulation.cloths()[0];
  const Vec3f there = cloth.state.position.at(held);
  FrameReport report;
  int frame = 0;
  for (report.seam_gap = 1; report.seam_gap > 0 && frame < 150; ++frame) {
    report = simulation.advance();
    ASSERT_LT(report.strain.max, 0.3) << frame;
    EXPECT_LT(length(cloth.state.position.at(held) - there), 2e-4F) << frame;
  }
  EXPECT_EQ(report.seam_gap, 0);
  const auto& [a, b] = cloth.garment->seams.front().pairs.front();
  EXPECT_EQ(cloth.state.position.at(a), cloth.state.position.at(b));
}

TEST_F(Sewing, PanelsComeTogetherFlat) {
  // Pulled at their edges alone, panels would bend and their edges go inwards, past what they are
  // to close round.
  scene_.bodies.clear();
  Simulation simulation(scene_, "scene", 1);
  const SimulatedCloth& cloth = simulation.cloths()[0];
  const Planes3 start = cloth.state.position;
  double inwards = 0;
  FrameReport report;
  for (report.seam_gap = 1; report.seam_gap > 0.02;) {
    report = simulation.advance();
    for (const auto& [a, b] : cloth.garment->seams.front().pairs)
      inwards = std::max(inwards,
                         double{std::abs(start.at(a).x) - std::abs(cloth.state.position.at(a).x)});
  }
  EXPECT_LT(inwards, 0.08);
}

TEST_F(Sewing, WindWaitsForGravity) {
  scene_.bodies.clear();
  Simulation still(scene_, "still", 1);
  scene_.wind.emplace().velocity = {3, 0, 0};
  Simulation windy(scene_, "windy", 1);
  for (FrameReport report; still.frame() == 0 || report.seam_gap > 0;) {
    ASSERT_EQ(windy.centre_of_mass(), still.centre_of_mass()) << "frame " << still.frame();
    report = still.advance();
    windy.advance();
  }
  for (int frame = 0; frame < 10; ++frame) windy.advance();
  EXPECT_GT(windy.centre_of_mass().x, still.centre_of_mass().x + 0.01);
}

TEST_F(Sewing, PanelsBeginOutsideOfBodies) {
  scene_.bodies[0].placement.scale = {0.3, 0.3, 0.3};
  Simulation simulation(scene_, "scene", 1);
  EXPECT_TRUE(simulation.start_insides().empty());
  EXPECT_NEAR(simulation.seam_gaps(0).front(), 0.24 + 2 * 0.06, 1e-3);
  EXPECT_EQ(simulation.intersections().total(), 0);
  // Panels that are all inside stay there.
  scene_.bodies[0].placement.scale = {1, 1, 1};
  EXPECT_NEAR(Simulation(scene_, "scene", 1).seam_gaps(0).front(), 0.24, 1e-3);
}

TEST_F(Sewing, BeginsWhereSeamsCloseOverABody) {
  // A beam of 72 by 11 by 10 cm: where its middle is at 1 m, it is in both seams up to 1.055 m.
  scene_.bodies[0].surface = "builtin:box";
  const auto up_with_beam = [&](double middle, double height = 0.11) {
    scene_.bodies[0].placement.scale = {1.2, 2.5 * height, 0.2};
    scene_.bodies[0].placement.translate = {0, middle, 0};
    return Simulation(scene_, "scene", 1).centre_of_mass().y - 1.1;
  };
  EXPECT_NEAR(up_with_beam(1.0), 0.03, 1e-5) << "half as much of the seams";
  EXPECT_NEAR(up_with_beam(0.9), 0, 1e-5) << "below all seams";
  EXPECT_NEAR(up_with_beam(1.225), -0.02, 1e-5) << "in their upper ends";
  EXPECT_NEAR(up_with_beam(1.1, 0.6), 0, 1e-5) << "in the way 10 cm higher or lower, too";
}

TEST_F(Sewing, StaysInARoomThatHoldsIt) {
  scene_.cloths = {test::tube_cloth(folder_ / "tube.json", 30, 10, 0.02)};
  scene_.bodies[0].surface = "builtin:box";  // 1.2 x 0.48 x 1 m, its ceiling 2 cm above
  scene_.bodies[0].placement.scale = {2, 1.2, 2};
  scene_.bodies[0].placement.translate = {0, 0.88, 0};
  EXPECT_NEAR(Simulation(scene_, "scene", 1).centre_of_mass().y, 1.05, 1e-5);
}

TEST_F(Sewing, SewsATriangleIntoASlit) {
  scene_.bodies.clear();
  write_file(scene_.cloths[0].surface.name,
             [&](std::ostream& out) { out << test::godet_pattern(); });
  scene_.cloths[0].spacing = 0.008;
  Simulation simulation(scene_, "scene", 1);
  FrameReport report;
  for (int frame = 0; frame < 40 && (frame == 0 || report.seam_gap > 0); ++frame) {
    report = simulation.advance();
    EXPECT_LT(report.strain.p99, 0.02) << frame;
  }
  EXPECT_EQ(report.seam_gap, 0);
  EXPECT_EQ(simulation.intersections().total(), 0);
}

TEST_F(Sewing, PairsThatMetStayTogether) {
  Simulation simulation(scene_, "scene", 1);
  const auto together = [&] {
    const SimulatedCloth& cloth = simulation.cloths()[0];
    int count = 0;
    for (const GarmentSeam& seam : cloth.garment->seams)
      for (const auto& [a, b] : seam.pairs)
        count += cloth.state.position.at(a) == cloth.state.position.at(b) ? 1 : 0;
    return count;
  };
  int before = 0;
  for (int frame = 0; frame < 60; ++frame) {
    simulation.advance();
    EXPECT_EQ(simulation.intersections().total(), 0) << frame;
    EXPECT_GE(together(), before) << frame;
    before = together();
  }
  EXPECT_GT(before, 0);
}

TEST_F(Sewing, TearsNothingWhereItIsTooNarrow) {
  // A tube of 60 cm about a ball of 94 cm that it cannot slide off, as a column goes through it.
  SceneBody column;
  column.surface = "builtin:box";
  column.placement.scale = {0.3, 6, 0.3};
  column.placement.translate = {0, 1.1, 0};
  scene_.bodies.push_back(column);
  scene_.bodies[0].placement.scale = {0.3, 0.3, 0.3};
  scene_.ground = 0;
  scene_.cloths[0].spacing = 0.04;
  Simulation simulation(scene_, "scene", 1);
  FrameReport report;
  for (int frame = 0; frame < 60; ++frame) report = simulation.advance();
  EXPECT_GT(report.seam_gap, 0);
  EXPECT_LT(report.strain.p99, 0.8);
  EXPECT_GT(std::ranges::max(simulation.seam_stretches(0)), 0.1);
  EXPECT_EQ(simulation.intersections().total(), 0);
}

/// A cone, 72 cm round where a tube closes about it, on which what has friction does not slide.
SceneBody steep_cone() {
  SceneBody cone;
  cone.surface = "builtin:cone";
  cone.size = 65;
  cone.placement.scale = {0.8, 20, 0.8};
  cone.placement.translate = {0, 1.9, 0};
  cone.friction = 1;
  return cone;
}

TEST_F(Sewing, SlidesToWhereItFits) {
  scene_.bodies = {steep_cone()};
  scene_.cloths[0].spacing = 0.04;
  Simulation simulation(scene_, "scene", 1), resumed(scene_, "scene", 1);
  SimulationState state;
  double when_closed = 0;
  FrameReport report;
  for (int frame = 0; frame < 25; ++frame) {
    const bool was_open = frame == 0 || report.seam_gap > 0;
    report = simulation.advance();
    if (frame > 15) resumed.advance();
    if (was_open && report.seam_gap == 0) when_closed = report.strain.p99;
    if (frame != 15) continue;
    simulation.save(state);
    resumed.restore(state);
  }
  EXPECT_GT(when_closed, 0.1);
  EXPECT_LT(report.strain.p99, 0.03);
  EXPECT_LT(std::ranges::max(simulation.seam_stretches(0)), 0.05);
  EXPECT_EQ(simulation.state_hash(), resumed.state_hash());
}

TEST_F(Sewing, PanelsBeginClearOfThinBodies) {
  // A needle of 4 mm through both panels, between their samples.
  scene_.bodies[0].surface = "builtin:box";
  scene_.bodies[0].placement.scale = {0.004, 0.004, 0.52};
  scene_.bodies[0].placement.translate = {0.005, 1.105, 0};
  Simulation simulation(scene_, "scene", 1);
  EXPECT_EQ(simulation.intersections().total(), 0);
  EXPECT_NEAR(simulation.seam_gaps(0).front(), 0.24 + 2 * 0.04, 1e-3);
}

TEST_F(Sewing, PanelsInOnePlaneDoNotTouch) {
  scene_.bodies.clear();
  write_file(scene_.cloths[0].surface.name,
             [&](std::ostream& out) { out << test::panels_side_by_side(); });
  Simulation simulation(scene_, "scene", 1);
  ASSERT_EQ(simulation.notes().size(), 1);
  EXPECT_NE(simulation.notes()[0].find("1 of 2 panels touched others"), std::string::npos);
  for (int frame = 0; frame < 5; ++frame) {
    simulation.advance();
    EXPECT_EQ(simulation.intersections().total(), 0) << frame;
  }
}

TEST_F(Sewing, PanelsBeginAboveTheGround) {
  scene_.bodies.clear();
  scene_.ground = 1.05;
  const Simulation simulation(scene_, "scene", 1);
  EXPECT_EQ(simulation.intersections().total(), 0);
  EXPECT_NEAR(simulation.centre_of_mass().y, 1.16, 1e-3);
  ASSERT_EQ(simulation.notes().size(), 1);
  EXPECT_NE(simulation.notes()[0].find("2 of 2 panels reached below the ground"),
            std::string::npos);
}

TEST_F(Sewing, GivesTheSameBitsOnAllThreads) {
  std::string first;
  for (const int threads : {1, 2, 3}) {
    Simulation simulation(scene_, "scene", threads);
    for (int frame = 0; frame < 20; ++frame) simulation.advance();
    if (first.empty()) first = simulation.state_hash();
    EXPECT_EQ(simulation.state_hash(), first) << threads;
  }
}

TEST_F(Sewing, GoesOnFromASavedState) {
  Simulation whole(scene_, "scene", 1), resumed(scene_, "scene", 1);
  SimulationState state;
  for (int frame = 0; frame < 100; ++frame) {
    if (frame == 12 || frame == 90) {
      whole.save(state);
      resumed.restore(state);
    }
    whole.advance();
    if (frame >= 12) resumed.advance();
  }
  EXPECT_EQ(whole.state_hash(), resumed.state_hash());
}

/// Opens a pair of a closed seam by 8 mm.
void open_pair(const Simulation& simulation, SimulationState& state) {
  const int sample = simulation.cloths()[0].garment->seams.front().pairs[5][0];
  Planes3& position = state.cloths[0].position;
  position.set(sample, position.at(sample) + Vec3f{0, 0, 0.008F});
}

TEST_F(Sewing, ClosesAgainWhatItTookApart) {
  Simulation whole(scene_, "scene", 1), resumed(scene_, "scene", 1);
  SimulationState state, opened;
  // In most frames it just closes; in some, it is taken apart.
  FrameReport report;
  for (int frame = 0; frame < 60 && report.seam_gap < 0.02; ++frame) {
    resumed.save(state);
    opened = state;
    if (frame >= 25) open_pair(resumed, opened);
    whole.restore(opened);
    report = whole.advance();
    if (frame < 25) report.seam_gap = 0;
    resumed.advance();
  }
  ASSERT_GT(report.seam_gap, 0.02);
  whole.save(state);
  resumed.restore(state);
  for (int frame = 0; frame < 30; ++frame) {
    report = whole.advance();
    resumed.advance();
  }
  EXPECT_EQ(report.seam_gap, 0);
  EXPECT_EQ(whole.intersections().total(), 0);
  EXPECT_EQ(whole.state_hash(), resumed.state_hash());
}

}  // namespace
}  // namespace weft::sewing_test
