#include "weft/convert/patch_deviation.h"

#include <gtest/gtest.h>

#include "tests/convert/maps.h"
#include "weft/convert/sample.h"

namespace weft {
namespace {

/// Of two triangles over the middle of a flat sheet, at a height in widths of theirs.
PatchDeviation of_square_at(double height, const std::vector<Vec3d>& points) {
  const MappedDisk mapped = maps::sheet(33, 17, maps::flat);
  const auto at = [&](double u, double v) {
    return maps::flat(u, v) +
           Vec3d{0, 0.2 * height * length(maps::flat(1, 0) - maps::flat(0, 0)), 0};
  };
  const std::vector<Corners> triangles{{at(0.4, 0.4), at(0.6, 0.4), at(0.4, 0.6)},
                                       {at(0.6, 0.6), at(0.4, 0.6), at(0.6, 0.4)}};
  std::vector<SurfaceSample> samples;
  for (const Vec3d point : points) samples.push_back({point, {}, {}});
  return PatchDeviation::of(triangles, samples, SlidingSurface(mapped));
}

TEST(PatchDeviation, IsThatOfTheTrianglesMiddlesFromTheSurface) {
  const PatchDeviation deviation = of_square_at(0.25, {});
  EXPECT_NEAR(deviation.largest, 0.25, 1e-6);
  EXPECT_NEAR(deviation.rms, 0.25, 1e-6);
}

TEST(PatchDeviation, IsThatOfPointsFromTheTriangles) {
  const PatchDeviation deviation = of_square_at(
      0, {maps::flat(0.5, 0.5), maps::flat(0.5, 0.5), maps::flat(0.7, 0.5), maps::flat(0.5, 0.5)});
  EXPECT_NEAR(deviation.largest, 0.5, 1e-6);
  EXPECT_NEAR(deviation.rms, 0.25, 1e-6);
}

}  // namespace
}  // namespace weft
