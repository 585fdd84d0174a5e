#include "weft/collide/broad_phase/shared_points.h"

#include <gtest/gtest.h>

#include "weft/core/random.h"
#include "weft/mesh/crossings.h"

namespace weft {
namespace {

/// Four cells; the first and the last share the middle sample alone.
struct FourCells {
  static constexpr int n = 3;
  SurfaceGrid grid{n, BorderMates(), {}};
  Planes3 start{n}, end{n};

  FourCells() {
    for (int s = 0; s < n * n; ++s)
      start.set(s, {static_cast<float>(s % n), 0, static_cast<float>(s / n)});
    end = start;
  }
  [[nodiscard]] bool apart(float slack, CandidatePair pair = {0, 3}) const {
    return apart_at_shared_point({&grid, &start, &end}, pair, slack);
  }
  /// Whether a triangle of the first cell crosses one of the last.
  [[nodiscard]] bool crosses(const Planes3& at) const {
    std::vector<Corners> triangles;
    for (const int cell : {0, 3})
      for (int half = 0; half < 2; ++half) {
        const std::array<int, 3> s = grid.triangle(cell, half);
        triangles.push_back({vec_cast<double>(at.at(s[0])), vec_cast<double>(at.at(s[1])),
                             vec_cast<double>(at.at(s[2]))});
      }
    bool found = false;
    for_self_crossings(triangles, {}, [&](int a, int b) { found = found || a / 2 != b / 2; });
    return found;
  }
};

TEST(SharedPoints, FlatCellsAreApartUpToTheirSlack) {
  const FourCells flat;
  EXPECT_TRUE(flat.apart(0.1F));
  EXPECT_FALSE(flat.apart(0.4F));  // their nearest other corners are 0.71 from the plane
}

TEST(SharedPoints, CellsThatShareAnEdgeOrNothingAreNotToldApart) {
  const FourCells flat;
  EXPECT_FALSE(flat.apart(0, {0, 1}));
  EXPECT_FALSE(flat.apart(0, {0, 0}));
}

TEST(SharedPoints, CellsThatFoldDuringTheStepAreNotApart) {
  FourCells cells;
  for (const int s : {5, 7, 8}) cells.end.set(s, {0.5F, 0, 0.5F});
  EXPECT_FALSE(cells.apart(0));
}

TEST(SharedPoints, WhatIsApartNeverCrosses) {
  Random random(3);
  int apart = 0, crossing = 0;
  for (int round = 0; round < 4000; ++round) {
    FourCells cells;
    const auto aside = [&](float most) { return most * static_cast<float>(random.uniform(-1, 1)); };
    for (Planes3* planes : {&cells.start, &cells.end})
      for (int s = 0; s < FourCells::n * FourCells::n; ++s)
        planes->set(s, planes->at(s) + Vec3f{aside(1.2F), aside(1.2F), aside(1.2F)});
    constexpr float slack = 0.02F;
    const bool certain = cells.apart(slack);
    apart += certain ? 1 : 0;
    for (const float time : {0.0F, 0.3F, 0.6F, 1.0F}) {
      Planes3 between(FourCells::n);
      for (int s = 0; s < FourCells::n * FourCells::n; ++s)
        between.set(s, cells.start.at(s) + time * (cells.end.at(s) - cells.start.at(s)) +
                           Vec3f{aside(0.5F * slack), aside(0.5F * slack), aside(0.5F * slack)});
      const bool crosses = cells.crosses(between);
      crossing += crosses ? 1 : 0;
      EXPECT_FALSE(certain && crosses) << round << " at " << time;
    }
  }
  EXPECT_GT(apart, 100);
  EXPECT_GT(crossing, 500);
}

}  // namespace
}  // namespace weft
