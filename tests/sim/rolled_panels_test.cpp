#include "weft/sim/sewing/rolled_panels.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/patterns.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tube_scene.h"
#include "weft/files.h"
#include "weft/sim/placement.h"
#include "weft/sim/sewing/tube_panel.h"

namespace weft {
namespace {

/// A pattern's panels where they begin.
struct Laid {
  explicit Laid(const std::string& pattern)
      : garment(make_garment(parse_pattern(pattern, "pattern"), "pattern", 0.01)),
        placed(placed_positions(garment.image, placement_map({}))) {}
  [[nodiscard]] double gap() const {
    double most = 0;
    for (const auto& [a, b] : garment.seams.front().pairs)
      most = std::max(most, static_cast<double>(length(placed.at(b) - placed.at(a))));
    return most;
  }
  Garment garment;
  Planes3 placed;
};

TEST(RolledPanels, BandsBeginAsTubesWithAGap) {
  Laid band(test::band_pattern(60, 10, 100, 20));
  const Planes3 flat = band.placed;
  EXPECT_EQ(roll_up_panels(band.garment, {}, band.placed), std::vector<char>{1});
  const double radius = 0.6 / (2 * M_PI * 0.9);
  EXPECT_NEAR(band.gap(), 2 * radius * std::sin(0.1 * M_PI), 1e-4);
  const BorderMates& mates = band.garment.image.mates;
  for (int s = 0; s < mates.size() * mates.size(); ++s) {
    const Vec3f p = band.placed.at(s);
    EXPECT_NEAR(std::hypot(p.x, p.z - 0.2 + radius), radius, 1e-5) << s;
    EXPECT_EQ(p.y, flat.at(s).y) << s;
    if (flat.at(s).x == 0) {
      EXPECT_NEAR(p.z, 0.2, 1e-5) << "the middle stays, the inner side is in";
    }
  }
}

TEST(RolledPanels, TubesGoRoundTheBodyBehindThem) {
  const test::TemporaryFolder folder;
  write_file(folder / "band.json",
             [](std::ostream& out) { out << test::band_pattern(60, 10, 105, 30); });
  Scene scene;
  scene.ground.reset();
  scene.cloths.resize(1);
  scene.cloths[0].surface = (folder / "band.json").string();
  scene.cloths[0].spacing = 0.02;
  scene.bodies = {test::ball_in_tube(1.1)};
  scene.bodies[0].placement.translate.x = 0.07;  // beside the middle of the band
  Simulation simulation(scene, "scene", 1);
  const Planes3& start = simulation.cloths()[0].state.position;
  float back = 1;
  for (int s = 0; s < start.size() * start.size(); ++s) back = std::min(back, start.at(s).z);
  EXPECT_LT(back, -0.05);
  EXPECT_TRUE(std::any_of(simulation.notes().begin(), simulation.notes().end(), [](const auto& n) {
    return n.find("begin rolled up") != std::string::npos;
  }));
  FrameReport report;
  int frame = 0;
  for (report.seam_gap = 1; report.seam_gap > 0 && frame < 100; ++frame) {
    report = simulation.advance();
    ASSERT_EQ(simulation.crossings(), 0) << frame;
    ASSERT_LT(report.strain.max, 0.1) << frame;
  }
  EXPECT_EQ(report.seam_gap, 0) << "after " << frame << " frames";
}

TEST(RolledPanels, StayFlatWhereNoTubeIsFree) {
  // A wall right behind the band, as large as the band is.
  Laid band(test::band_pattern(60, 10, 100, 20));
  Scene scene;
  scene.cloths.resize(1);
  SceneBody wall;
  wall.surface = "builtin:box";
  wall.size = 33;
  wall.placement.scale = {4, 4, 0.7};
  wall.placement.translate = {0, 1, -0.17};
  scene.bodies = {wall};
  const Simulation simulation(scene, "scene", 1);
  const Planes3 flat = band.placed;
  EXPECT_EQ(roll_up_panels(band.garment, simulation.bodies(), band.placed), std::vector<char>{0});
  EXPECT_EQ(band.placed.at(0), flat.at(0));
}

TEST(RolledPanels, PanelsThatTaperBecomeConesOfAboutTheirLengths) {
  Laid cone(R"({"pattern":{"panels":{"skirt":{"vertices":[[-60,0],[60,0],[42,55],[-42,55]],
    "edges":[{"endpoints":[0,1]},{"endpoints":[1,2]},{"endpoints":[2,3]},{"endpoints":[3,0]}],
    "translation":[0,50,22],"rotation":[0,0,0]}},
    "stitches":[[{"panel":"skirt","edge":1},{"panel":"skirt","edge":3}]]},
    "properties":{"units_in_meter":100}})");
  const Planes3 flat = cone.placed;
  EXPECT_EQ(roll_up_panels(cone.garment, {}, cone.placed), std::vector<char>{1});
  const Chart& chart = cone.garment.image.mates.charts()[0];
  for (int r = chart.row; r + 1 < chart.row + chart.rows; ++r)
    for (int c = chart.col; c + 1 < chart.col + chart.cols; ++c)
      for (const auto& [row, col] : {std::pair{r + 1, c}, std::pair{r, c + 1}}) {
        const double before = length(flat.at(row, col) - flat.at(r, c));
        EXPECT_NEAR(length(cone.placed.at(row, col) - cone.placed.at(r, c)), before, 0.2 * before)
            << r << ", " << c;
      }
}

TEST(RolledPanels, DartsAndOrdinarySeamsRollNothing) {
  Laid dart(
      R"({"pattern":{"panels":{"front":{"vertices":[[0,0],[18,0],[20,15],[22,0],[40,0],[40,50],[0,50]],
    "edges":[{"endpoints":[0,1]},{"endpoints":[1,2]},{"endpoints":[2,3]},{"endpoints":[3,4]},
             {"endpoints":[4,5]},{"endpoints":[5,6]},{"endpoints":[6,0]}],
    "translation":[-20,100,0],"rotation":[0,0,0]}},
    "stitches":[[{"panel":"front","edge":1},{"panel":"front","edge":2}]]},
    "properties":{"units_in_meter":100}})");
  EXPECT_EQ(roll_up_panels(dart.garment, {}, dart.placed), std::vector<char>{0});
  Laid tube(test::tube_pattern(30, 20, 24, 100));
  EXPECT_EQ(roll_up_panels(tube.garment, {}, tube.placed), (std::vector<char>{0, 0}));
}

TEST(RolledPanels, EdgesInSeveralPartsMayBeNamedInAnyOrder) {
  // Each side of the band has two edges; the lower ones are named left first, the upper ones right.
  Laid band(
      R"({"pattern":{"panels":{"band":{"vertices":[[0,0],[60,0],[60,10],[60,20],[0,20],[0,10]],
    "edges":[{"endpoints":[0,1]},{"endpoints":[1,2]},{"endpoints":[2,3]},{"endpoints":[3,4]},
             {"endpoints":[4,5]},{"endpoints":[5,0]}],
    "translation":[-30,100,20],"rotation":[0,0,0]}},
    "stitches":[[{"panel":"band","edge":5},{"panel":"band","edge":1}],
                [{"panel":"band","edge":2},{"panel":"band","edge":4}]]},
    "properties":{"units_in_meter":100}})");
  EXPECT_EQ(roll_up_panels(band.garment, {}, band.placed), std::vector<char>{1});
  const double radius = 0.6 / (2 * M_PI * 0.9);
  EXPECT_NEAR(band.gap(), 2 * radius * std::sin(0.1 * M_PI), 1e-4);
}

TEST(RolledPanels, TubesTurnToWhatTheyAreSewnTo) {
  // A band before a panel that its upper edge is sewn to, which is at its left.
  Laid two(R"({"pattern":{"panels":{
    "band":{"vertices":[[0,0],[60,0],[60,10],[30,10],[0,10]],
      "edges":[{"endpoints":[0,1]},{"endpoints":[1,2]},{"endpoints":[2,3]},{"endpoints":[3,4]},{"endpoints":[4,0]}],
      "translation":[-30,100,0],"rotation":[0,0,0]},
    "side":{"vertices":[[0,0],[30,0],[30,20],[0,20]],
      "edges":[{"endpoints":[0,1]},{"endpoints":[1,2]},{"endpoints":[2,3]},{"endpoints":[3,0]}],
      "translation":[-45,115,-10],"rotation":[0,0,0]}},
    "stitches":[[{"panel":"band","edge":1},{"panel":"band","edge":4}],
                [{"panel":"side","edge":0},{"panel":"band","edge":2}]]},
    "properties":{"units_in_meter":100}})");
  const auto away = [&](const Planes3& placed) {
    double sum = 0;
    for (const auto& [a, b] : two.garment.seams[1].pairs)
      sum += squared_length(placed.at(b) - placed.at(a));
    return sum;
  };
  const int band = two.garment.image.mates.charts()[0].name == "band" ? 0 : 1;
  const TubePanel panel(two.garment, band, two.placed);
  ASSERT_TRUE(panel.is_tube());
  const double turn = panel.best_turn({0.9});
  for (const double other : {-1.0, -0.5, 0.5, 1.0})
    EXPECT_LT(away(panel.rolled({0.9, 0, 0, turn})), away(panel.rolled({0.9, 0, 0, turn + other})));
}

}  // namespace
}  // namespace weft
