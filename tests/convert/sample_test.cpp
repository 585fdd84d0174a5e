#include "weft/convert/sample.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tests/convert/maps.h"
#include "weft/error.h"

namespace weft {
namespace {

void expect_covered_once(const MappedDisk& mapped) {
  const Grid<int> times = coverage(mapped);
  const int n = times.rows();
  for (int row = 0; row < n; ++row)
    for (int col = 0; col < n; ++col) {
      const bool inside = row > 0 && col > 0 && row < n - 1 && col < n - 1;
      ASSERT_EQ(times(row, col), inside ? 1 : 0) << row << ' ' << col;
    }
}

// Positions that are a linear function of uv, wherever the vertices lie.
MappedDisk straightened(MappedDisk mapped) {
  const double side = mapped.map.size.cols - 1;
  for (std::size_t k = 0; k < mapped.map.uv.size(); ++k)
    mapped.cut.disk.positions[k] = maps::flat(mapped.map.uv[k].x / side, mapped.map.uv[k].y / side);
  return mapped;
}

TEST(Sample, VerticesOnSamplesAreCoveredOnce) {
  expect_covered_once(maps::sheet(17, 17, maps::flat));
  expect_covered_once(maps::sheet(33, 9, maps::flat));
  expect_covered_once(maps::sheet(9, 33, maps::flat));
}

TEST(Sample, SliversAndVerticesOnSamplesAreCoveredOnce) {
  for (int seed = 0; seed < 20; ++seed) {
    MappedDisk mapped = maps::sheet(33, seed % 2 == 0 ? 33 : 21, maps::flat);
    maps::shake(mapped, seed);
    expect_covered_once(mapped);
  }
}

TEST(Sample, FlatSheetIsReproducedWhereverItsVerticesLie) {
  const int n = 33;
  MappedDisk mapped = maps::sheet(n, 21, maps::flat);
  maps::shake(mapped, 3);
  const GeometryImage image = sample_image(straightened(std::move(mapped)));
  for (int row = 0; row < n; ++row)
    for (int col = 0; col < n; ++col) {
      const Vec3d p = image.world_position(row, col);
      EXPECT_NEAR(p.x, col / (n - 1.0), 1e-6);
      EXPECT_NEAR(p.y, 0, 1e-6);
      EXPECT_NEAR(p.z, -row / (n - 1.0), 1e-6);
    }
}

TEST(Sample, CubeIsFilledAlongTheLongestSide) {
  const auto plank = [](double u, double v) { return Vec3d{10 + 4 * u, 2, 1 - v}; };
  const GeometryImage image = sample_image(maps::sheet(9, 5, plank));
  EXPECT_EQ(image.world.lower, (Vec3d{10, 2, 0}));
  EXPECT_EQ(image.world.scale, 4);
  EXPECT_EQ(image.cube.at(0, 0), (Vec3f{0, 0, 0.25F}));
  EXPECT_EQ(image.cube.at(8, 8), (Vec3f{1, 0, 0}));
}

TEST(Sample, MatesHoldTheSameBits) {
  for (const int m : {8, 12, 17, 40}) {
    const GeometryImage torus = sample_image(maps::torus(17, m));
    EXPECT_EQ(torus.mates.class_count(), 1 + 2 * 15);
    EXPECT_TRUE(mates_bit_equal(torus));
    const GeometryImage pillow = sample_image(maps::pillow(17, m));
    EXPECT_EQ(pillow.mates.class_count(), 31);
    EXPECT_TRUE(mates_bit_equal(pillow));
  }
}

TEST(Sample, BorderSamplesLieOnTheSurfaceCurve) {
  const int n = 17;
  const int m = 8;
  const GeometryImage image = sample_image(maps::torus(n, m));
  for (int col = 0; col < n; ++col) {
    // Between two vertices of the circle that the cut runs along.
    const double place = col * (m - 1.0) / (n - 1);
    const double low = std::floor(place);
    const Vec3d a = maps::torus_point(low / (m - 1), 0);
    const Vec3d b = maps::torus_point((low + 1) / (m - 1), 0);
    const Vec3d expected = a + (place - low) * (b - a);
    EXPECT_LT(length(image.world_position(0, col) - expected), 1e-6) << col;
    EXPECT_EQ(image.cube.at(0, col), image.cube.at(n - 1, col));
  }
}

TEST(Sample, FlippedTriangleIsRefused) {
  MappedDisk mapped = maps::sheet(17, 17, maps::flat);
  mapped.map.uv[8 * 17 + 8] = {12.5, 12.25};
  try {
    sample_image(mapped);
    FAIL() << "accepted";
  } catch (const TopologyError& error) {
    EXPECT_NE(std::string(error.what()).find("not covered exactly once"), std::string::npos);
  }
}

TEST(Normals, FlatSheetHasOneNormal) {
  const NormalMap map = sample_normals(maps::sheet(9, 7, maps::flat), 20);
  EXPECT_EQ(map.size(), 20);
  for (int sample = 0; sample < 400; ++sample) {
    EXPECT_NEAR(map.normal.at(sample).x, 0, 1e-7);
    EXPECT_NEAR(map.normal.at(sample).y, 1, 1e-7);
    EXPECT_NEAR(map.normal.at(sample).z, 0, 1e-7);
  }
}

TEST(Normals, TorusNormalsPointOutwards) {
  const int n = 33;
  const NormalMap map = sample_normals(maps::torus(n, 65), n);
  for (int row = 0; row < n; ++row)
    for (int col = 0; col < n; ++col) {
      const double u = 2 * pi * col / (n - 1.0);
      const double v = 2 * pi * row / (n - 1.0);
      const Vec3d exact{cosine(v) * cosine(u), sine(v), -cosine(v) * sine(u)};
      const Vec3d normal = vec_cast<double>(map.normal.at(row, col));
      EXPECT_NEAR(length(normal), 1, 1e-6);
      EXPECT_GT(dot(normal, exact), 0.998) << row << ' ' << col;
    }
}

TEST(Normals, MatesHoldTheSameBitsAtEveryMultipleOfTheSize) {
  const int n = 9;
  for (const MappedDisk& mapped : {maps::torus(n, 12), maps::pillow(n, 7)})
    for (const int times : {1, 2, 3}) {
      const int size = times * (n - 1) + 1;
      const NormalMap map = sample_normals(mapped, size);
      GeometryImage image{map.normal, {}, {}, {}, {}};
      std::vector<MateInterval> intervals = sample_image(mapped).mates.intervals();
      for (MateInterval& run : intervals)
        run = {times * run.first, times * run.mate, times * run.count};
      image.mates = BorderMates(size, intervals);
      EXPECT_TRUE(mates_bit_equal(image)) << times;
    }
}

}  // namespace
}  // namespace weft
