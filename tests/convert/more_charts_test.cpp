#include "weft/convert/more_charts.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/convert_options.h"
#include "weft/convert/pieces.h"
#include "weft/core/math.h"
#include "weft/error.h"
#include "weft/image_file.h"
#include "weft/param/square_map.h"
#include "weft/shapes.h"

namespace weft {
namespace {

using test::sized;
using test::unmeasured;

/// Charts of 1000 triangles each, all of the same stretch.
Conversion with_stretch(int charts, double stretch, double psnr = 50) {
  Conversion made;
  auto mapped = std::make_shared<MappedDisk>();
  mapped->quality.stretch_l2 = stretch;
  auto piece = std::make_shared<Piece>();
  piece->triangle.resize(1000);
  for (int k = 0; k < charts; ++k) made.charts.push_back({mapped, {}, piece});
  made.map_quality.stretch_l2 = stretch;
  made.input.mesh.triangles.resize(1000);
  made.image.cube = Planes3(257);
  made.quality.psnr_db = psnr;
  made.seconds.map = 1;
  return made;
}

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

TEST(MoreCharts, TheirNumberGoesByStretchSamplesAndTriangles) {
  EXPECT_EQ(more_charts_for(with_stretch(1, 1.4)).most, 0) << "nothing is stretched";
  EXPECT_EQ(more_charts_for(with_stretch(1, 6)).first, 8);
  EXPECT_EQ(more_charts_for(with_stretch(1, 16)).first, 16);
  EXPECT_EQ(more_charts_for(with_stretch(1, 1e30)).first, 31) << "1000 triangles";
  Conversion small = with_stretch(1, 16);
  small.image.cube = Planes3(97);
  EXPECT_EQ(more_charts_for(small).most, 8) << "samples";
}

TEST(MoreCharts, TheFirstGoodImageIsTakenAndTold) {
  std::vector<int> tried;
  const Conversion made =
      with_more_charts(with_stretch(1, 100), {.first = 8, .most = 32}, [&](int charts) {
        tried.push_back(charts);
        return with_stretch(charts, charts > 30 ? 3 : 40, 49.9);
      });
  EXPECT_EQ(tried, (std::vector<int>{9, 33}));
  EXPECT_EQ(made.charts.size(), 33u);
  EXPECT_EQ(made.seconds.map, 3);
  ASSERT_EQ(made.warnings.size(), 1u);
  EXPECT_NE(made.warnings[0].find("in 1 chart the image would be poor: stretch 100"),
            std::string::npos);
  EXPECT_NE(made.warnings[0].find("33 charts were taken"), std::string::npos);
}

TEST(MoreCharts, NoSecondTrialFollowsAGainOfSixDecibels) {
  for (const double gain : {5.9, 6.1}) {
    int trials = 0;
    const Conversion made =
        with_more_charts(with_stretch(1, 100), {.first = 8, .most = 32}, [&](int charts) {
          ++trials;
          return with_stretch(charts, 3, 50 + gain);
        });
    EXPECT_EQ(trials, gain > 6 ? 1 : 2);
    EXPECT_EQ(made.charts.size(), 9u) << "no more charts than gain";
  }
}

TEST(MoreCharts, WhereNoneMendsTheBestPsnrIsTakenIfItIsMuchBetter) {
  for (const double gain : {0.4, 0.6}) {
    const Conversion made = with_more_charts(
        with_stretch(3, 100), {.first = 8, .most = 32},
        [&](int charts) { return with_stretch(charts, 10, 50 + (charts == 11 ? gain : 0)); });
    EXPECT_EQ(made.charts.size(), gain > 0.5 ? 11u : 3u);
  }
}

TEST(MoreCharts, TheFirstStaysWhereOthersLoseFailOrNeedALargerImage) {
  std::vector<int> tried;
  const Conversion failing = with_more_charts(with_stretch(1, 100), {.first = 32, .most = 32},
                                              [&](int charts) -> std::optional<Conversion> {
                                                tried.push_back(charts);
                                                if (charts == 9)
                                                  throw TopologyError("", "9 charts", "fewer");
                                                return std::nullopt;
                                              });
  EXPECT_EQ(tried, (std::vector<int>{33, 9}));
  EXPECT_EQ(failing.charts.size(), 1u);
  EXPECT_TRUE(failing.warnings.empty());
  const Conversion losing =
      with_more_charts(with_stretch(1, 100), {.first = 8, .most = 8},
                       [](int charts) { return with_stretch(charts, 2, 49.7); });
  EXPECT_EQ(losing.charts.size(), 1u);
}

TEST(MoreCharts, WhatAllTrialsAreToldIsToldOnce) {
  Conversion first = with_stretch(1, 100);
  first.warnings = {"the seam is short", "of the first alone"};
  const Conversion made =
      with_more_charts(std::move(first), {.first = 8, .most = 32}, [](int charts) {
        Conversion trial = with_stretch(charts, 3);
        trial.warnings = {"the seam is short", "of the trial alone"};
        return trial;
      });
  ASSERT_EQ(made.warnings.size(), 4u);
  EXPECT_EQ(made.warnings[0], "the seam is short");
  EXPECT_EQ(made.warnings[1], "of the first alone");
  EXPECT_EQ(made.warnings[2], "of the trial alone");
}

TEST(MoreCharts, SecondsAreThoseOfFailedTrialsToo) {
  constexpr std::chrono::milliseconds pause(30);
  const auto failing = [&](int charts) -> std::optional<Conversion> {
    std::this_thread::sleep_for(pause);
    if (charts > 20) return std::nullopt;
    throw TopologyError("", "too many charts", "fewer");
  };
  const Conversion made =
      with_more_charts(with_stretch(1, 100), {.first = 32, .most = 32}, failing);
  EXPECT_GE(made.seconds.cut, 0.06) << "of two";
  EXPECT_EQ(made.seconds.map, 1) << "of the first image";
}

/// A wire of twelve turns, hundreds of times longer than thick, beside a ball.
TriangleMesh wire_and_ball() {
  TriangleMesh mesh = make_shape("sphere");
  constexpr int around = 6, rings = 480;
  const auto first = static_cast<int>(mesh.positions.size());
  for (int i = 0; i <= rings; ++i)
    for (int k = 0; k < around; ++k) {
      const double angle = 24 * pi * i / rings, across = 2 * pi * k / around;
      const double radius = 0.5 + 0.02 * cosine(across);
      mesh.positions.push_back(
          {3 + radius * cosine(angle), 0.002 * i + 0.02 * sine(across), radius * sine(angle)});
    }
  for (int i = 0; i < rings; ++i)
    for (int k = 0; k < around; ++k) {
      const int a = first + i * around + k, b = first + i * around + (k + 1) % around;
      mesh.triangles.push_back({a, b, b + around});
      mesh.triangles.push_back({a, b + around, a + around});
    }
  return mesh;
}

TEST(MoreCharts, WiresAreDividedAndWhatIsGoodStaysWhole) {
  const TriangleMesh mesh = wire_and_ball();
  ConvertOptions options = sized(129);
  options.charts = ChartChoice::pieces;
  const Conversion pieces = convert_mesh(mesh, "wire", options);
  ASSERT_TRUE(is_poor(pieces));
  EXPECT_EQ(pieces.charts.size(), 2u);
  const Conversion made = convert_mesh(mesh, "wire", sized(129));
  EXPECT_GT(made.charts.size(), 4u);
  EXPECT_GT(made.quality.psnr_db, pieces.quality.psnr_db + 2);
  EXPECT_EQ(made.quality.euler, pieces.input.counts.euler);
  EXPECT_EQ(made.quality.boundaries, pieces.input.counts.boundaries);
  const std::size_t ball = make_shape("sphere").triangles.size();
  EXPECT_TRUE(std::any_of(made.charts.begin(), made.charts.end(), [&](const ConvertedChart& c) {
    return c.piece->triangle.size() == ball;
  }));
}

TEST(MoreCharts, TheSameImageWhetherItIsMeasuredOrNot) {
  const TriangleMesh mesh = wire_and_ball();
  EXPECT_EQ(exr_bytes(convert_mesh(mesh, "wire", sized(65)).image),
            exr_bytes(convert_mesh(mesh, "wire", unmeasured(65)).image));
}

}  // namespace
}  // namespace weft
