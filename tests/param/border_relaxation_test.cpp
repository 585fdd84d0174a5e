#include "weft/param/border_relaxation.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/param/layout_cases.h"
#include "tests/support/meshes.h"
#include "weft/core/random.h"
#include "weft/param/newton_system.h"
#include "weft/param/square_map.h"
#include "weft/param/stretch_newton.h"

namespace weft::border_relaxation_test {
namespace {

struct LaidOut {
  CutDisk cut;
  BorderLayout layout;
  std::vector<Vec2d> uv;  // the border's
  std::vector<BorderFreedom> freedoms;
};

LaidOut laid_out(CutDisk cut, const LayoutOptions& options) {
  LaidOut made{std::move(cut), {}, {}, {}};
  made.layout = lay_out_border(made.cut, options);
  split_at_corners(made.cut, made.layout);
  const std::vector<double> t = border_positions(made.cut, made.layout);
  made.uv.resize(made.cut.disk.positions.size());
  for (std::size_t b = 0; b < t.size(); ++b)
    made.uv[made.cut.disk.border[b]] = border_point(options.size, t[b]);
  made.freedoms = border_freedoms(made.cut, made.layout, t);
  return made;
}

bool on_square(Vec2d p, double side) {
  const bool inside = p.x >= 0 && p.y >= 0 && p.x <= side && p.y <= side;
  return inside && (p.x == 0 || p.y == 0 || p.x == side || p.y == side);
}

/// Both mates' places along their paths add up to the paths' length, to the last bit.
void expect_exact_mates(const CutDisk& cut, const BorderLayout& layout, std::span<const Vec2d> uv) {
  const int count = static_cast<int>(cut.disk.border.size());
  const double around = layout.size.around();
  const auto place = [&](int path, int j) {
    const int v = cut.disk.border[(cut.paths[path].first + j) % count];
    const double along = border_position_of(layout.size, uv[v]) - layout.first[path];
    return along < 0 ? along + around : along;
  };
  for (std::size_t p = 0; p < cut.paths.size(); ++p) {
    const int mate = cut.paths[p].mate;
    if (mate < 0) continue;
    for (int j = 1; j < cut.paths[p].edges; ++j)
      EXPECT_EQ(place(static_cast<int>(p), j) + place(mate, cut.paths[p].edges - j),
                layout.intervals[p]);
  }
}

TEST(BorderPositionOf, InvertsBorderPoint) {
  for (double t = 0; t < 64; t += 0.375) EXPECT_EQ(border_position_of(17, border_point(17, t)), t);
}

TEST(BorderRelaxation, LeaveNodesAndCornersAlone) {
  for (const test::Case& c : test::layout_cases()) {
    SCOPED_TRACE(c.name);
    const LaidOut made = laid_out(c.cut, {17, 3});
    std::vector<int> moving;
    for (const BorderFreedom& freedom : made.freedoms) {
      moving.push_back(freedom.vertex);
      if (freedom.mate >= 0) moving.push_back(freedom.mate);
    }
    std::sort(moving.begin(), moving.end());
    EXPECT_EQ(std::adjacent_find(moving.begin(), moving.end()), moving.end());
    for (const int v : moving) EXPECT_NE(std::fmod(border_position_of(17, made.uv[v]), 16), 0);
    for (const BorderPath& path : made.cut.paths)
      EXPECT_FALSE(
          std::binary_search(moving.begin(), moving.end(), made.cut.disk.border[path.first]));
  }
}

TEST(BorderRelaxation, SettledMatesCorrespondExactly) {
  for (const test::Case& c : test::layout_cases()) {
    SCOPED_TRACE(c.name);
    LaidOut made = laid_out(c.cut, {33, 5});
    Random random(3);
    for (const BorderFreedom& freedom : made.freedoms) {
      const double distance = random.uniform(-1e-3, 1e-3);
      (freedom.axis == 0 ? made.uv[freedom.vertex].x : made.uv[freedom.vertex].y) += distance;
    }
    snap_to_grid(made.freedoms, made.uv);
    expect_exact_mates(made.cut, made.layout, made.uv);
    for (const int v : made.cut.disk.border) EXPECT_TRUE(on_square(made.uv[v], 32));
  }
}

/// A torus mapped with its border by arc length, and what may slide from there.
struct Torus {
  MappedDisk mapped;
  std::vector<BorderFreedom> freedoms;
};

Torus torus_by_arc_length() {
  const TriangleMesh mesh = test::torus(30, 14);
  const StretchOptions plain{.iterations = 2, .newton_steps = 0};
  Torus torus{map_to_square(cut_open(mesh, open_to_disk(mesh)),
                            {.size = 33, .parameterizer = plain, .rotations = 1}),
              {}};
  torus.freedoms = border_freedoms(torus.mapped.cut, torus.mapped.layout,
                                   border_positions(torus.mapped.cut, torus.mapped.layout));
  return torus;
}

double along(Vec2d p, int axis) { return axis == 0 ? p.x : p.y; }

TEST(NewtonSystem, MovesMatesTogetherAlongTheirSides) {
  const auto [mapped, freedoms] = torus_by_arc_length();
  ASSERT_GT(freedoms.size(), 10U);
  const DiskGeometry geometry(mapped.cut.disk);
  const NewtonSystem::Step step = NewtonSystem(geometry, freedoms).solve(mapped.map.uv);
  ASSERT_FALSE(step.move.empty());
  double slid = 0;
  for (const BorderFreedom& freedom : freedoms) {
    const double move = along(step.move[freedom.vertex], freedom.axis);
    EXPECT_EQ(along(step.move[freedom.vertex], 1 - freedom.axis), 0);
    EXPECT_EQ(along(step.move[freedom.mate], freedom.mate_axis), freedom.sign * move);
    EXPECT_EQ(along(step.move[freedom.mate], 1 - freedom.mate_axis), 0);
    slid = std::max(slid, std::abs(move));
  }
  EXPECT_GT(slid, 1e-3);
}

TEST(NewtonSystem, SlopeOfAStepWithSlidesMatchesFiniteDifferences) {
  const auto [mapped, freedoms] = torus_by_arc_length();
  const DiskGeometry geometry(mapped.cut.disk);
  const NewtonSystem::Step step = NewtonSystem(geometry, freedoms).solve(mapped.map.uv);
  ASSERT_FALSE(step.move.empty());
  const auto energy_at = [&, &map = mapped.map](double h) {
    std::vector<Vec2d> moved = map.uv;
    for (std::size_t v = 0; v < moved.size(); ++v) moved[v] = moved[v] + h * step.move[v];
    return geometry.energy(moved);
  };
  const double h = 1e-4;
  const double difference = (energy_at(h) - energy_at(-h)) / (2 * h);
  EXPECT_NEAR(step.slope, difference, 1e-4 * std::abs(difference));
}

TEST(StretchNewton, SlidingLowersTheEnergyAtEveryStepAndKeepsMatesExact) {
  auto [mapped, freedoms] = torus_by_arc_length();
  const DiskGeometry geometry(mapped.cut.disk);
  std::vector<Vec2d> fixed = mapped.map.uv;
  minimise_by_newton(geometry, fixed, {.steps = 30, .min_gain = 0});
  double before = geometry.energy(mapped.map.uv);
  for (int step = 0; step < 30; ++step) {
    minimise_by_newton(geometry, mapped.map.uv, {.steps = 1, .min_gain = 0, .freedoms = freedoms});
    const double after = geometry.energy(mapped.map.uv);
    EXPECT_LE(after, before);
    before = after;
    EXPECT_TRUE(is_valid_map(mapped.cut.disk.triangles, mapped.map.uv));
    expect_exact_mates(mapped.cut, mapped.layout, mapped.map.uv);
  }
  EXPECT_LT(before, geometry.energy(fixed));
}

}  // namespace
}  // namespace weft::border_relaxation_test
