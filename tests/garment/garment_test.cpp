#include "weft/garment.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "tests/support/patterns.h"
#include "weft/error.h"

namespace weft {
namespace {

Garment tube(double spacing) {
  return make_garment(parse_pattern(test::tube_pattern(40, 30, 20, 100), "p"), "p", spacing);
}

TEST(Garment, LaysEachPanelFlatInAChart) {
  const Garment garment = tube(0.02);
  ASSERT_EQ(garment.image.mates.charts().size(), 2U);
  for (const Chart& chart : garment.image.mates.charts()) {
    EXPECT_EQ(std::max(chart.rows, chart.cols), 21);
    EXPECT_EQ(std::min(chart.rows, chart.cols), 17);  // 15 intervals, in fours
  }
  EXPECT_TRUE(mates_bit_equal(garment.image));
}

TEST(Garment, JoinsSeamsEndToStart) {
  const Garment garment = tube(0.02);
  ASSERT_EQ(garment.seams.size(), 2U);
  for (const GarmentSeam& seam : garment.seams) {
    EXPECT_EQ(seam.pairs.size(), 17U);
    for (const auto& [a, b] : seam.pairs) {
      const int n = garment.image.size();
      const Vec3d p = garment.image.world_position(a / n, a % n),
                  q = garment.image.world_position(b / n, b % n);
      EXPECT_NEAR(p.x, q.x, 1e-6);
      EXPECT_NEAR(p.y, q.y, 1e-6);
      EXPECT_NEAR(std::abs(p.z - q.z), 0.2, 1e-6);
      EXPECT_EQ(garment.sewn.representative(a), garment.sewn.representative(b));
    }
  }
  EXPECT_TRUE(garment.sewn.keep_manifold());
}

TEST(Garment, PutsRowsAlongTheGrain) {
  const Garment garment = tube(0.02);
  for (const Chart& chart : garment.image.mates.charts()) {
    const Vec3f step = garment.texture.at(chart.row + 3, chart.col + 4) -
                       garment.texture.at(chart.row + 3, chart.col + 3);
    EXPECT_NEAR(step.x, 0, 1e-6);
    EXPECT_GT(step.y, 0.01);
  }
}

TEST(Garment, TurnsAPanelOverWhereAStitchSaysRightToWrong) {
  std::string text = test::tube_pattern(40, 30, 20, 100);
  for (const char* edge : {"\"edge\":2}]", "\"edge\":0}]"}) {
    const std::size_t at = text.find(edge);
    ASSERT_NE(at, std::string::npos);
    text.insert(at + 9, ",\"right_wrong\"");
  }
  const Garment garment = make_garment(parse_pattern(text, "p"), "p", 0.02);
  EXPECT_TRUE(garment.sewn.keep_manifold());
  EXPECT_EQ(garment.seams.size(), 2U);
}

TEST(Garment, RefusesOneThatHasOneSideOnly) {
  std::string text = test::tube_pattern(40, 30, 20, 100);
  text.insert(text.find("\"edge\":2}]") + 9, ",\"right_wrong\"");
  EXPECT_THROW(make_garment(parse_pattern(text, "p"), "p", 0.02), InputError);
}

/// Remembers fractions, and stops the work after so many.
class Listener final : public Progress {
 public:
  explicit Listener(std::size_t most) : most_(most) {}
  void update(std::string_view /*stage*/, double fraction) override {
    told.push_back(fraction);
    if (told.size() == most_) throw Interrupted();
  }
  std::vector<double> told;

 private:
  std::size_t most_;
};

TEST(Garment, TellsHowFarItIsAndStopsWhenAsked) {
  const Pattern pattern = parse_pattern(test::tube_pattern(40, 30, 20, 100), "p");
  Listener whole(0);
  make_garment(pattern, "p", 0.01, &whole);
  EXPECT_TRUE(std::is_sorted(whole.told.begin(), whole.told.end()));
  EXPECT_GE(whole.told.front(), 0);
  EXPECT_GE(whole.told.back(), 0.5);
  EXPECT_LE(whole.told.back(), 1);
  Listener part(whole.told.size() / 2);
  EXPECT_THROW(make_garment(pattern, "p", 0.01, &part), Interrupted);
}

TEST(Garment, MakesChartsOfAllSharedPatterns) {
  const std::filesystem::path folder = std::filesystem::path(WEFT_SHARED_DIR) / "patterns";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not there";
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".json") {
      const std::string name = entry.path().string();
      const Garment garment = make_garment(read_pattern(name), name, 0.03);
      EXPECT_FALSE(garment.seams.empty()) << name;
      ++count;
    }
  EXPECT_GE(count, 14);
}

}  // namespace
}  // namespace weft
