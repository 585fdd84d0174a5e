#include "weft/sim/sewing/panel_starts.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/patterns.h"
#include "weft/sim/placement.h"

namespace weft {
namespace {

/// Half a hood and the top that it is sewn on, where they begin.
struct HalfHood {
  explicit HalfHood(double turn, double low, const std::string& label = "", double height = 20)
      : garment(make_garment(parse_pattern(test::half_hood(turn, low, label, height), "pattern"),
                             "pattern", 0.01)),
        placed(placed_positions(garment.image, placement_map({}))),
        raised(raise_above_others(garment, std::vector<char>(2), placed)) {}
  [[nodiscard]] double lowest(int panel) const {
    const Chart& chart = garment.image.mates.charts()[panel];
    float least = 1e9F;
    for (int r = chart.row; r < chart.row + chart.rows; ++r)
      for (int c = chart.col; c < chart.col + chart.cols; ++c)
        least = std::min(least, placed.at(r, c).y);
    return least;
  }
  Garment garment;
  Planes3 placed;
  MovedPanels raised;
};

TEST(PanelStarts, HoodsBeginAboveTheirTops) {
  const HalfHood hood(90, 115);
  EXPECT_EQ(hood.raised.count, 1);
  EXPECT_EQ(hood.garment.image.mates.charts()[hood.raised.farthest].name, "hood");
  EXPECT_NEAR(hood.raised.distance, 0.25, 1e-5);
  EXPECT_NEAR(hood.lowest(hood.raised.farthest), 1.4, 1e-5);
  EXPECT_NEAR(hood.lowest(1 - hood.raised.farthest), 1, 1e-5);
}

TEST(PanelStarts, LeavesAloneWhatIsInNobodysWay) {
  EXPECT_EQ(HalfHood(0, 115).raised.count, 0) << "in the plane of the top";
  EXPECT_EQ(HalfHood(90, 105).raised.count, 0) << "beside the top";
  EXPECT_EQ(HalfHood(90, 141).raised.count, 0) << "above the top";
  EXPECT_EQ(HalfHood(90, 115, "", 4).raised.count, 0) << "as low as a collar";
  EXPECT_EQ(HalfHood(90, 115, "collar").raised.count, 0) << "where it is worn";
}

}  // namespace
}  // namespace weft
