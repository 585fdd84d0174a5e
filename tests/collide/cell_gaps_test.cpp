#include "weft/collide/broad_phase/cell_gaps.h"

#include <gtest/gtest.h>

#include "weft/collide/contacts/closest.h"
#include "weft/core/random.h"

namespace weft {
namespace {

/// One cell in motion.
struct OneCell {
  SurfaceGrid grid{2, BorderMates(), {}};
  Planes3 start{2}, end{2};

  OneCell(Random& random, Vec3d at) {
    const auto any = [&](double size) {
      return size * Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    };
    const Vec3d displacement = any(0.01);
    for (int s = 0; s < 4; ++s) {
      const Vec3d p = at + Vec3d{0.01 * (s % 2), 0, 0.01 * (s / 2)} + any(0.003);
      start.set(s, vec_cast<float>(p));
      end.set(s, vec_cast<float>(p + displacement + any(0.002)));
    }
  }
  [[nodiscard]] MovingSurface surface() const { return {&grid, &start, &end}; }
  [[nodiscard]] Feature triangle(int half, double time) const {
    Feature feature;
    for (std::size_t k = 0; k < 3; ++k) {
      const int s = grid.triangle(0, half)[k];
      feature.corners[k] =
          (1 - time) * vec_cast<double>(start.at(s)) + time * vec_cast<double>(end.at(s));
    }
    return feature;
  }
};

double distance(const OneCell& a, const OneCell& b, double time) {
  double min = HUGE_VAL;
  for (int i = 0; i < 4; ++i)
    min = std::min(
        min, closest_points(a.triangle(i / 2, time), b.triangle(i % 2, time)).squared_distance);
  return std::sqrt(min);
}

/// Near the origin and where single precision is coarse.
TEST(CellGaps, WhatIsApartKeepsItsGapsAtBothEndsAndNeverMeets) {
  Random random(7);
  for (const double far : {0.0, 300.0}) {
    int apart = 0;
    for (int round = 0; round < 20000; ++round) {
      const Vec3d at{far, -far, far};
      const OneCell a(random, at),
          b(random,
            at + 0.02 * Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
      const double at_start = random.uniform(0, 0.004), at_end = random.uniform(0, 0.004);
      if (!CellGaps(a.surface(), 0, b.surface(), 0).apart(at_start, at_end)) continue;
      ++apart;
      EXPECT_GT(distance(a, b, 0), at_start);
      EXPECT_GT(distance(a, b, 1), at_end);
      for (const double time : {0.25, 0.5, 0.75}) EXPECT_GT(distance(a, b, time), 0);
    }
    EXPECT_GT(apart, 3000);
  }
}

TEST(CellGaps, NoTwoPointsComeNearerThanTheMostApproach) {
  Random random(8);
  for (int round = 0; round < 5000; ++round) {
    const OneCell a(random, {}), b(random, {0.01, 0.005, 0});
    const double max = CellGaps(a.surface(), 0, b.surface(), 0).max_approach();
    EXPECT_GE(distance(a, b, 1), distance(a, b, 0) - max);
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const Vec3f displacement = (a.end.at(i) - a.start.at(i)) - (b.end.at(j) - b.start.at(j));
        EXPECT_LE(std::sqrt(squared_length(displacement)), 1.0001 * max);
      }
  }
}

}  // namespace
}  // namespace weft
