#include "weft/collide/broad_phase/unfolded_seams.h"

#include <gtest/gtest.h>

#include "tests/collide/halved_sheet.h"
#include "weft/collide/broad_phase/unfolded_windows.h"
#include "weft/collide/moving_surface.h"
#include "weft/core/random.h"

namespace weft {
namespace {

using test::HalvedSheet;

/// A flat sheet with its samples moved about.
Planes3 shaken(double noise, std::uint64_t seed) {
  Random random(seed);
  Planes3 sheet(HalvedSheet::n);
  const auto next = [&] { return static_cast<float>(0.2 * noise * random.uniform(-1, 1)); };
  for (int s = 0; s < HalvedSheet::n * HalvedSheet::n; ++s)
    sheet.set(s, {0.2F * static_cast<float>(s % HalvedSheet::n) + next(), next(),
                  0.3F * static_cast<float>(s / HalvedSheet::n) + next()});
  return sheet;
}

UnfoldedWindows windows_of(const SurfaceGrid& grid, const Planes3& at, float slack) {
  UnfoldedWindows windows(grid.cells());
  ThreadTeam team(1);
  windows.find_unfolded({&grid, &at, &at}, slack, team);
  return windows;
}

/// What the test says of every pair of cells at most two apart, on both sides of the seam.
struct Verdicts {
  int same = 0, different = 0, unfolded = 0;
  void compare(const HalvedSheet& halved, const Planes3& sheet, float slack) {
    const SurfaceGrid whole(HalvedSheet::n, BorderMates(), {}),
        cut(HalvedSheet::size, halved.mates, {});
    const Planes3 image = halved.image_of(sheet);
    const UnfoldedWindows of_whole = windows_of(whole, sheet, slack),
                          of_cut = windows_of(cut, image, slack);
    for (int r = 0; r < 8; ++r)
      for (int c = 2; c < 4; ++c)
        for (int q = std::max(0, r - 2); q <= std::min(7, r + 2); ++q)
          for (int d = 4; d <= c + 2; ++d) {
            // Of cells within two of the seam alone: windows that lie farther to a side count not.
            const bool known = of_whole.unfolded(Node{0, r, c}, Node{0, q, d});
            const bool found =
                of_cut.unfolded(CandidatePair{halved.image_cell(r, c), halved.image_cell(q, d)});
            ++(known == found ? same : different);
            unfolded += found ? 1 : 0;
            EXPECT_TRUE(known || !found) << r << " " << c << " " << q << " " << d;
          }
  }
};

TEST(UnfoldedSeams, FindWhatTheUncutSheetHas) {
  for (int way = 0; way < 8; ++way) {
    const HalvedSheet halved(way);
    Verdicts verdicts;
    for (std::uint64_t seed = 1; seed <= 60; ++seed)
      verdicts.compare(halved, shaken(0.01 * static_cast<double>(seed), seed), 0.001F);
    EXPECT_GT(verdicts.unfolded, 1000) << way;
    // Small windows that fail lie in larger ones that hold more often where there is no seam.
    EXPECT_LT(verdicts.different, 0.02 * verdicts.same) << way;
  }
}

TEST(UnfoldedSeams, SeeFoldsAtTheSeam) {
  for (int way = 0; way < 8; ++way) {
    const HalvedSheet halved(way);
    Planes3 sheet = shaken(0, 1);
    for (int r = 0; r < HalvedSheet::n; ++r)
      for (int c = HalvedSheet::half + 1; c < HalvedSheet::n; ++c) {
        const Vec3f there = sheet.at(r, 2 * HalvedSheet::half - c);
        sheet.set(r, c, {there.x, 0.01F, there.z});
      }
    const SurfaceGrid cut(HalvedSheet::size, halved.mates, {});
    const Planes3 image = halved.image_of(sheet);
    const UnfoldedWindows windows = windows_of(cut, image, 0);
    for (int r = 0; r < 8; ++r)
      EXPECT_FALSE(
          windows.unfolded(CandidatePair{halved.image_cell(r, 3), halved.image_cell(r, 4)}));
  }
}

TEST(SeamStrips, HoldTheCellsOnBothSidesInOrder) {
  for (int way = 0; way < 8; ++way) {
    const HalvedSheet halved(way);
    const SeamStrips seams(halved.mates);
    ASSERT_EQ(seams.strips().size(), 1U);
    const SeamStrips::Strip& strip = seams.strips().front();
    ASSERT_EQ(strip.count, 8);
    for (int r = 0; r < 8; ++r)
      for (int k = 0; k < SeamStrips::rows; ++k) {
        const int cell = halved.image_cell(r, 2 + k);
        EXPECT_EQ(seams.column(strip, r)[k], cell);
        ASSERT_EQ(seams.places(cell).size(), 1U);
        EXPECT_EQ(seams.places(cell)[0].col, r);
        EXPECT_EQ(seams.places(cell)[0].row, k);
      }
  }
}

}  // namespace
}  // namespace weft
