#include "weft/convert/unfold_samples.h"

#include <gtest/gtest.h>

#include "tests/convert/maps.h"
#include "weft/convert/rasterise.h"
#include "weft/convert/sample.h"
#include "weft/core/math.h"

namespace weft {
namespace {

constexpr int size = 33, fine = 257;

/// A flat sheet, turned about its middle: by most within a few samples of it, by none at the
/// border.
Vec3d swirl(double u, double v) {
  const double x = u - 0.5, y = v - 0.5;
  const double angle = 5 * std::exp(-(x * x + y * y) / (0.12 * 0.12));
  const double c = cosine(angle), s = sine(angle);
  return maps::flat(0.5 + c * x - s * y, 0.5 + s * x + c * y);
}

int count_reversed(const GeometryImage& image) {
  int reversed = 0;
  for (const auto& [a, b, c] : grid_triangles(image)) {
    const auto at = [&](int s) { return image.world_position(s / size, s % size); };
    reversed += cross(at(b) - at(a), at(c) - at(a)).y <= 0 ? 1 : 0;
  }
  return reversed;
}

MappedDisk unfolded(MappedDisk mapped) {
  mapped.map.sample_places = unfolded_places(mapped);
  return mapped;
}

TEST(UnfoldSamples, LeavesNoReversedTriangleInASwirl) {
  const MappedDisk mapped = maps::sheet(size, fine, swirl);
  ASSERT_GT(count_reversed(sample_image(mapped)), 4);
  EXPECT_EQ(count_reversed(sample_image(unfolded(mapped))), 0);
}

TEST(UnfoldSamples, LeavesWhatIsNotFolded) {
  EXPECT_TRUE(unfolded_places(maps::sheet(size, 17, maps::flat)).empty());
  EXPECT_TRUE(unfolded_places(maps::torus(size, 17)).empty());
}

TEST(UnfoldSamples, BorderAndFarSamplesStay) {
  const MappedDisk mapped = unfolded(maps::sheet(size, fine, swirl));
  int moved = 0;
  for (int row = 0; row < size; ++row)
    for (int col = 0; col < size; ++col) {
      const Vec2d place = mapped.map.sample_places[row * size + col];
      const bool stays = place == Vec2d{double(col), double(row)};
      if (std::max(std::abs(row - 16), std::abs(col - 16)) > 12) {
        EXPECT_TRUE(stays);
      }
      moved += stays ? 0 : 1;
    }
  EXPECT_GT(moved, 20);
}

TEST(UnfoldSamples, GridsOfEverySizeAreCoveredOnce) {
  const MappedDisk mapped = unfolded(maps::sheet(size, fine, swirl));
  for (const int samples : {size, 65, 97, 47}) {
    Grid<int> times(samples, samples, 0);
    rasterise(mapped.cut.disk, mapped.map, samples,
              [&](int row, int col, int) { ++times(row, col); });
    for (int row = 0; row < samples; ++row)
      for (int col = 0; col < samples; ++col) {
        const bool inside = row > 0 && col > 0 && row < samples - 1 && col < samples - 1;
        ASSERT_EQ(times(row, col), inside ? 1 : 0) << samples << ' ' << row << ' ' << col;
      }
  }
}

/// What is sampled beside positions comes from the same points of the surface.
TEST(UnfoldSamples, FinerSamplesLieBetweenThoseThatSlid) {
  const MappedDisk mapped = unfolded(maps::sheet(size, fine, swirl));
  for (int row = 0; row < 2 * size - 1; row += 2)
    for (int col = 0; col < 2 * size - 1; ++col) {
      const auto place = [&](int r, int c) { return sample_place(r, c, 2 * size - 1, mapped.map); };
      const Vec2d at = place(row, col);
      if (col % 2 == 0) {
        EXPECT_EQ(at, mapped.map.sample_places[row / 2 * size + col / 2]);
      } else {
        EXPECT_LT(length(at - 0.5 * (place(row, col - 1) + place(row, col + 1))), 1e-12);
      }
    }
}

}  // namespace
}  // namespace weft
