#include <algorithm>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "tests/collide/test_bodies.h"
#include "weft/collide/intersections.h"
#include "weft/collide/moving_surface.h"
#include "weft/collide/untangle/intersection_contours.h"
#include "weft/collide/untangle/smooth_move.h"
#include "weft/core/random.h"

namespace weft {
namespace {

using test::octahedral_sphere;
using test::TestCloth;

constexpr double step = 1.0 / 240, spacing = 0.05;

/// Cloths without forces: what moves them is the collider alone.
class Tangle {
 public:
  /// @param side  samples of each
  void add(const Planes3& start, const BorderMates& mates = {}) {
    mates_.push_back(std::make_unique<BorderMates>(mates));
    cloths_.push_back(std::make_unique<TestCloth>(start.size()));
    cloths_.back()->start = cloths_.back()->position = start;
    triangles_.emplace_back();
    const SurfaceGrid grid(start.size(), mates, {});
    for (int t = 0; t < 2 * grid.cells() * grid.cells(); ++t) {
      const std::array<int, 3> samples = grid.triangle(t / 2, t % 2);
      if (!grid.folded(samples)) triangles_.back().push_back({samples[0], samples[1], samples[2]});
    }
  }
  void pin(std::size_t cloth, int row, int col) { cloths_[cloth]->inverse_mass(row, col) = 0; }
  TestCloth& cloth(std::size_t index) { return *cloths_[index]; }

  /// As the exact checker counts them, which shares no code with the collider.
  [[nodiscard]] std::int64_t intersections() const {
    std::vector<GridTriangles> grids;
    for (std::size_t i = 0; i < cloths_.size(); ++i)
      grids.push_back({&cloths_[i]->position, &triangles_[i]});
    return IntersectionCheck(grids, {}, {}).count().total();
  }
  /// @return the step at whose end nothing crosses any more, or `max`
  int untangle(int max, int threads = 1) {
    make_collider();
    ThreadTeam team(threads);
    for (int number = 1; number <= max; ++number) {
      take_step(team);
      if (intersections() == 0) return number;
    }
    return max;
  }
  void take_step(ThreadTeam& team) {
    make_collider();
    std::vector<MovingCloth> moving;
    for (const auto& cloth : cloths_) moving.push_back(cloth->moving());
    collider_->detect(moving, step, team);
    collider_->filter(moving, step, team);
    farthest_ = 0;
    for (const auto& cloth : cloths_)
      for (int s = 0; s < cloth->start.size() * cloth->start.size(); ++s) {
        const Vec3f displacement = cloth->position.at(s) - cloth->start.at(s);
        farthest_ = std::max(farthest_, std::sqrt(double{squared_length(displacement)}));
      }
    for (const auto& cloth : cloths_) cloth->start = cloth->position;
  }
  [[nodiscard]] const Collider& collider() const { return *collider_; }
  /// That any sample went in the last step [m].
  [[nodiscard]] double farthest() const { return farthest_; }

 private:
  void make_collider() {
    if (collider_) return;
    for (std::size_t i = 0; i < cloths_.size(); ++i)
      statistics_.push_back({.mates = *mates_[i],
                             .size = cloths_[i]->start.size(),
                             .thickness = 0.004,
                             .rest_spacing = spacing,
                             .self_collision = true,
                             .self_thickness = 0.004});
    collider_ = weft::make_collider(PyramidOptions{}, {}, statistics_);
  }
  std::vector<std::unique_ptr<BorderMates>> mates_;
  std::vector<std::unique_ptr<TestCloth>> cloths_;
  std::vector<std::vector<Triangle>> triangles_;
  std::vector<CollidingCloth> statistics_;
  std::unique_ptr<Collider> collider_;
  double farthest_ = 0;
};

template <class At>
Planes3 placed(int n, const At& at) {
  Planes3 planes(n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) planes.set(r, c, vec_cast<float>(Vec3d(at(r, c))));
  return planes;
}

/// In the plane y = 0, centred.
Planes3 lying(int n) {
  return placed(n, [&](int r, int c) {
    return Vec3d{spacing * (c - 0.5 * (n - 1)), 0, spacing * (r - 0.5 * (n - 1))};
  });
}
/// Upright and a little askew, its centre here.
Planes3 upright(int n, Vec3d centre) {
  return placed(n, [&](int r, int c) {
    const double x = spacing * (c - 0.5 * (n - 1)), y = spacing * (r - 0.5 * (n - 1));
    return centre + Vec3d{x, y + 0.02 * x, 0.1 * x + 0.05 * y};
  });
}

/// A strip rolled by so many half turns, its end pushed on straight from there.
Vec3d rolled(double displacement, double radius, double half_turns) {
  const double max = half_turns * pi, turned = std::min(displacement / radius, max);
  const double rest = std::max(0.0, displacement - radius * max);
  return {-radius * sine(turned) - rest * cosine(turned),
          radius * (1 - cosine(turned)) + rest * sine(turned), 0};
}

TEST(Untangler, ASheetPartlyThroughAnotherComesOut) {
  Tangle tangle;
  tangle.add(lying(17));
  tangle.add(upright(9, {0.01, 0.13, 0.02}));
  ASSERT_GT(tangle.intersections(), 10);
  EXPECT_LT(tangle.untangle(120), 120);
  // The smaller part has followed the larger one up.
  for (int s = 0; s < 81; ++s) EXPECT_GT(tangle.cloth(1).position.at(s).y, -0.1F);
  EXPECT_GT(tangle.cloth(1).position.at(4, 4).y, 0.13F);
}

TEST(Untangler, ASheetThroughTheMiddleOfAnotherIsPulledOutOverItsBorder) {
  Tangle tangle;
  tangle.add(lying(17));
  tangle.add(upright(9, {0.01, -0.02, 0.02}));
  ASSERT_GT(tangle.intersections(), 10);
  EXPECT_LT(tangle.untangle(240), 240);
}

TEST(Untangler, SheetsThatCrossAtTheirBordersSlideApart) {
  Tangle tangle;
  tangle.add(lying(17));
  tangle.add(upright(17, {0.31, 0.01, 0.02}));
  ASSERT_GT(tangle.intersections(), 10);
  EXPECT_LT(tangle.untangle(240), 240);
}

TEST(Untangler, SheetsThatHardlySlopeThroughEachOtherComeApart) {
  Tangle tangle;
  tangle.add(lying(17));
  tangle.add(placed(17, [](int r, int c) {
    const double x = spacing * (c - 8) + 0.11, z = spacing * (r - 8) + 0.13;
    return Vec3d{x, 0.01 + 0.1 * z, z};
  }));
  ASSERT_GT(tangle.intersections(), 10);
  EXPECT_LT(tangle.untangle(240), 240);
}

TEST(Untangler, ACornerThatIsRolledThroughItsSheetComesBack) {
  Tangle tangle;
  tangle.add(placed(25, [](int r, int c) {
    const double x = spacing * c, z = spacing * r, displacement = (0.5 - (x + z)) / std::sqrt(2.0);
    if (displacement <= 0) return Vec3d{x, 0, z};
    const Vec3d at = rolled(displacement, 0.05, 1.3);
    const double aside = std::sqrt(0.5) * (displacement + at.x);
    return Vec3d{x + aside, at.y, z + aside};
  }));
  ASSERT_GT(tangle.intersections(), 3);
  EXPECT_LT(tangle.untangle(120), 120);
}

TEST(Untangler, ARibbonThatCrossesItselfOpens) {
  Tangle tangle;
  tangle.add(placed(25, [](int r, int c) {
    const double displacement = spacing * (c - 12);
    const Vec3d at = rolled(std::abs(displacement), 0.12, 0.8);
    return Vec3d{displacement < 0 ? at.x : -at.x, at.y + 0.002 * r, spacing * r};
  }));
  ASSERT_GT(tangle.intersections(), 10);
  EXPECT_LT(tangle.untangle(240), 240);
}

TEST(Untangler, NoisyLayersOfAFoldedSheetComeApart) {
  Tangle tangle;
  Random random(7);
  tangle.add(placed(33, [&](int r, int c) {
    const int layer = c / 8, along = c % 8;
    const double noise = random.uniform(-0.003, 0.003);
    return Vec3d{spacing * (layer % 2 == 0 ? along : 8 - along), 0.0005 * c + noise, spacing * r};
  }));
  ASSERT_GT(tangle.intersections(), 100);
  EXPECT_LT(tangle.untangle(240), 240);
}

TEST(Untangler, ClosedSurfacesLeaveEachOtherAcrossTheirSeams) {
  Tangle tangle;
  const Body low = octahedral_sphere(17, 0.3, {0, 0, 0});
  // Its lowest point is where the four corners of its square meet.
  const Body high = octahedral_sphere(17, 0.3, {0.03, 0.52, 0.02});
  tangle.add(low.positions, low.mates);
  tangle.add(high.positions, high.mates);
  ASSERT_GT(tangle.intersections(), 10);
  EXPECT_LT(tangle.untangle(120), 120);
  for (int k = 0; k < high.mates.class_count(); ++k)
    for (const int s : high.mates.mates(k))
      EXPECT_EQ(tangle.cloth(1).position.at(s),
                tangle.cloth(1).position.at(high.mates.mates(k)[0]));
}

TEST(Untangler, WhatIsPinnedStaysAndTheOtherGoes) {
  Tangle tangle;
  tangle.add(lying(17));
  tangle.add(upright(9, {0.01, 0.13, 0.02}));
  for (int r = 0; r < 17; ++r)
    for (int c = 0; c < 17; ++c) tangle.pin(0, r, c);
  const Planes3 before = tangle.cloth(0).start;
  EXPECT_LT(tangle.untangle(240), 240);
  for (int s = 0; s < 17 * 17; ++s) EXPECT_EQ(tangle.cloth(0).position.at(s), before.at(s));
}

TEST(Untangler, MovesAreSmallAndLendNoSpeed) {
  Tangle tangle;
  tangle.add(lying(17));
  tangle.add(upright(9, {0.01, 0.13, 0.02}));
  ThreadTeam team(1);
  for (int number = 0; number < 60; ++number) {
    tangle.take_step(team);
    EXPECT_LE(tangle.farthest(), 0.25 * spacing);
    for (std::size_t cloth = 0; cloth < 2; ++cloth)
      for (int s = 0; s < 81; ++s) ASSERT_EQ(tangle.cloth(cloth).velocity.at(s), Vec3f{});
  }
  EXPECT_EQ(tangle.collider().crossings(), 0);
}

TEST(Untangler, WhatHasComeApartIsHeldApart) {
  Tangle tangle;
  tangle.add(lying(17));
  tangle.add(upright(9, {0.01, 0.13, 0.02}));
  ASSERT_LT(tangle.untangle(120), 120);
  ThreadTeam team(1);
  // It is thrown back, as far as it was.
  for (int number = 0; number < 10; ++number) {
    for (int s = 0; s < 81; ++s)
      tangle.cloth(1).position.set(s, tangle.cloth(1).start.at(s) + Vec3f{0, -0.05F, 0});
    tangle.take_step(team);
    EXPECT_EQ(tangle.intersections(), 0) << number;
    EXPECT_EQ(tangle.collider().crossings(), 0);
  }
}

TEST(Untangler, TeamsOfAnySizeGiveTheSameBits) {
  const auto run = [](int threads) {
    Tangle tangle;
    tangle.add(lying(17));
    tangle.add(upright(17, {0.31, 0.01, 0.02}));
    ThreadTeam team(threads);
    for (int number = 0; number < 10; ++number) tangle.take_step(team);
    std::vector<float> numbers;
    for (int s = 0; s < 17 * 17; ++s)
      for (std::size_t cloth = 0; cloth < 2; ++cloth) {
        const Vec3f at = tangle.cloth(cloth).position.at(s);
        for (const float x : {at.x, at.y, at.z}) numbers.push_back(x);
      }
    return numbers;
  };
  const std::vector<float> one = run(1);
  for (const int threads : {2, 3, 7}) EXPECT_EQ(run(threads), one);
}

/// All pairs of cells of two surfaces.
std::vector<CandidateTile> all_cells(int a, int b) {
  std::vector<CandidatePair> pairs;
  for (int i = 0; i < a * a; ++i)
    for (int j = 0; j < b * b; ++j) pairs.push_back({i, j});
  std::vector<CandidateTile> cells;
  join_to_tiles(Tiling(a), Tiling(b), pairs, cells);
  return cells;
}

TEST(IntersectionContours, SheetsThatCrossAtTheirBordersHaveOneCurveWithTwoEnds) {
  const Planes3 low = lying(9), high = upright(9, {0.11, 0.01, 0.02});
  const BorderMates none;
  const SurfaceGrid grid(9, none, {});
  ThreadTeam team(1);
  IntersectionContours contours;
  contours.find({{&grid, &grid}, {&low, &high}, false}, all_cells(8, 8), team);
  ASSERT_EQ(contours.count(), 1);
  int ends = 0;
  for (const ContourNode& node : contours.nodes()) {
    ends += node.segments == 1 ? 1 : 0;
    EXPECT_NEAR(node.point.y, 0, 1e-7);
    EXPECT_EQ(node.layer == contours.nodes()[0].layer,
              node.crossing.side == contours.nodes()[0].crossing.side);
  }
  EXPECT_EQ(ends, 2);
}

TEST(IntersectionContours, ACurveThroughSamplesAndEdgesIsOneCurveToo) {
  // Every crossing is where a sample or an edge of one meets one of the other.
  const Planes3 low = lying(9), high = placed(9, [](int r, int c) {
                                  return Vec3d{spacing * (c - 4), spacing * (r - 4), 0};
                                });
  const BorderMates none;
  const SurfaceGrid grid(9, none, {});
  ThreadTeam team(1);
  IntersectionContours contours;
  contours.find({{&grid, &grid}, {&low, &high}, false}, all_cells(8, 8), team);
  EXPECT_EQ(contours.count(), 1);
  EXPECT_GE(contours.nodes().size(), 9U);
}

TEST(Regions, ARingOfCutEdgesCutsOutWhatItHolds) {
  const BorderMates none;
  const SurfaceGrid grid(9, none, {});
  // Rising diagonals: a sample's six edges.
  const int s = 4 * 9 + 4;
  std::vector<CutEdge> cut{{s - 10, s}, {s - 9, s}, {s - 1, s},
                           {s, s + 1},  {s, s + 9}, {s, s + 10}};
  Regions regions;
  regions.find(grid, cut);
  EXPECT_EQ(regions.size(regions.of(s)), 1);
  EXPECT_EQ(regions.size(regions.of(0)), 80);
  // One of them is passed a second time, the other way.
  cut.insert(cut.begin(), cut.front());
  regions.find(grid, cut);
  EXPECT_EQ(regions.size(regions.of(s)), 81);
}

TEST(SmoothMove, WhatAContourWantsGoesOnAroundItAndFades) {
  const BorderMates none;
  const SurfaceGrid grid(65, none, {});
  SmoothMove move;
  move.clear(grid, 3);
  for (int c = 0; c < 65; ++c) move.want(10 * 65 + c, {0, 0.01, 0}, 1);
  move.spread(grid);
  EXPECT_NEAR(move.at(10 * 65 + 30).y, 0.01, 1e-12);
  EXPECT_NEAR(move.at(12 * 65 + 30).y, 0.01, 2e-3);
  EXPECT_GT(move.at(6 * 65 + 30).y, 0.005);
  EXPECT_EQ(move.at(60 * 65 + 30), Vec3d{});
}

}  // namespace
}  // namespace weft
