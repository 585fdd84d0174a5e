#include "weft/convert/more_charts.h"

#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "weft/error.h"

namespace weft {
namespace {

Conversion with_stretch(int charts, double stretch) {
  Conversion made;
  made.charts.resize(static_cast<std::size_t>(charts));
  made.map_quality.stretch_l2 = stretch;
  made.input.mesh.triangles.resize(1000);
  made.seconds.map = 1;
  return made;
}

double stretch_as_psnr(const Conversion& made) { return 100 - made.map_quality.stretch_l2; }

TEST(MoreCharts, StretchAreaAndFoldsEachMakeAnImagePoor) {
  Conversion made = with_stretch(1, 5);
  EXPECT_FALSE(is_poor(made));
  made.quality.area_ratio = 1.06;
  EXPECT_TRUE(is_poor(made));
  made.quality.area_ratio = 1;
  made.quality.reversed_area = 0.021;
  EXPECT_TRUE(is_poor(made));
  EXPECT_TRUE(is_poor(with_stretch(1, 5.1)));
}

TEST(MoreCharts, TheFewestThatMendAreTakenAndTold) {
  std::vector<int> tried;
  const Conversion made = with_more_charts(
      with_stretch(1, 100),
      [&](int charts) {
        tried.push_back(charts);
        return with_stretch(charts, 40.0 / charts);
      },
      stretch_as_psnr);
  EXPECT_EQ(tried, (std::vector<int>{2, 4, 8}));
  EXPECT_EQ(made.charts.size(), 8u);
  EXPECT_EQ(made.seconds.map, 4);
  ASSERT_EQ(made.warnings.size(), 1u);
  EXPECT_NE(made.warnings[0].find("in 1 chart the image would be poor: stretch 100"),
            std::string::npos);
  EXPECT_NE(made.warnings[0].find("8 charts were taken"), std::string::npos);
}

TEST(MoreCharts, WhereNoneMendsTheBestPsnrIsTaken) {
  const Conversion made = with_more_charts(
      with_stretch(3, 100), [](int charts) { return with_stretch(charts, charts == 24 ? 10 : 50); },
      stretch_as_psnr);
  EXPECT_EQ(made.charts.size(), 24u);
}

TEST(MoreCharts, TheFirstStaysWhereMoreFailOrNeedALargerImage) {
  const Conversion made = with_more_charts(
      with_stretch(1, 100),
      [](int charts) -> std::optional<Conversion> {
        if (charts == 4) throw TopologyError("", "4 charts", "fewer");
        return std::nullopt;
      },
      stretch_as_psnr);
  EXPECT_EQ(made.charts.size(), 1u);
  EXPECT_TRUE(made.warnings.empty());
}

}  // namespace
}  // namespace weft
