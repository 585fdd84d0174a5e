#include <gtest/gtest.h>

#include "tests/cloth/baselines/filter_residual.h"
#include "tests/cloth/sheets.h"
#include "weft/cloth/baselines/multigrid/multigrid_preconditioner.h"
#include "weft/cloth/mates.h"
#include "weft/convert.h"

namespace weft {
namespace {

using namespace testing;

constexpr double frame_time = 1.0 / 60;

/// The sides of a square in the order of its border, a b a' b' c d c' d' in eighths: a closed
/// surface of genus 2.
BorderMates double_torus_mates(int n) {
  const int half = (n - 1) / 2;
  return {n,
          {{0, 3 * half, half},
           {half, 4 * half, half},
           {4 * half, 7 * half, half},
           {5 * half, 8 * half, half}}};
}

/// A square whose springs are all alike, glued into a closed surface: what fills no room, but
/// a filter only knows rest lengths.
Cloth glued_square(int n, const BorderMates& mates) {
  return make_cloth(flat_sheet(n), mates, soft_fabric);
}

struct Solver {
  Solver(const Cloth& of, int sweeps)
      : cloth(of),
        levels(make_filter_levels(of, frame_time)),
        filter(of, {frame_time, sweeps}, team) {
    Grid<float> moves(of.size, of.size, 1);
    for (const Pin& held : of.pins)
      for (const int s : held.copies) moves(s / of.size, s % of.size) = 0;
    renew_weights(levels, moves);
  }
  Planes3 clear_held(Planes3 x) const {
    for (const Pin& held : cloth.pins)
      for (const int s : held.copies) x.set(s, {});
    return x;
  }
  /// A x, whole values.
  Planes3 times(const Planes3& x) const {
    Planes3 out = filter_residual(levels.front(), Planes3(cloth.size), x);
    sum_over_mates(cloth.mates, {&out.x, &out.y, &out.z});
    for (int s = 0; s < cloth.size * cloth.size; ++s) out.set(s, -1.0F * out.at(s));
    return clear_held(std::move(out));
  }
  const Planes3& cycle(const Planes3& right) {
    filter.rhs() = right;
    team.run([&](Worker& worker) { filter.cycle(worker); });
    return filter.value();
  }
  double dot_of(const Planes3& a, const Planes3& b) const {
    double sum = 0;
    for (int s = 0; s < cloth.size * cloth.size; ++s)
      sum += double{cloth.owner(s / cloth.size, s % cloth.size)} *
             dot(vec_cast<double>(a.at(s)), vec_cast<double>(b.at(s)));
    return sum;
  }

  const Cloth& cloth;
  std::vector<FilterLevel> levels;
  ThreadTeam team{1};
  MultigridPreconditioner filter;
};

void add(float factor, const Planes3& term, Planes3& sum) {
  for (int s = 0; s < sum.size() * sum.size(); ++s) sum.set(s, sum.at(s) + factor * term.at(s));
}

/// How much of the error in A's norm one of many cycles leaves.
double convergence_factor(const Cloth& cloth, int sweeps) {
  Solver solver(cloth, sweeps);
  Planes3 x(cloth.size);
  shake(cloth, 1, x);
  x = solver.clear_held(std::move(x));
  const auto energy = [&] { return solver.dot_of(x, solver.times(x)); };
  double before = 0;
  const int skipped = 4, cycles = 8;
  for (int i = 0; i < skipped + cycles; ++i) {
    if (i == skipped) before = energy();
    add(-1, Planes3(solver.cycle(solver.times(x))), x);
  }
  return std::pow(energy() / before, 0.5 / cycles);
}

/// Conjugate gradients preconditioned by a cycle until the residual in W's norm falls to 1e-4.
int iterations_of(const Cloth& cloth) {
  Solver solver(cloth, 1);
  const int n = cloth.size;
  Planes3 residual(n), x(n), direction(n);
  for (int s = 0; s < n * n; ++s)
    residual.set(s, cloth.mass(s / n, s % n) * Vec3f{0.3F, -9.81F, 0.1F});
  residual = solver.clear_held(std::move(residual));
  double slope = 0, first = 0;
  for (int i = 0; i < 200; ++i) {
    const Planes3 w = solver.cycle(residual);
    const double last = slope;
    slope = solver.dot_of(residual, w);
    if (i == 0) first = slope;
    if (slope <= 1e-8 * first) return i;
    for (int s = 0; s < n * n; ++s)
      direction.set(s, w.at(s) + static_cast<float>(i > 0 ? slope / last : 0) * direction.at(s));
    const Planes3 a = solver.times(direction);
    const auto step_length = static_cast<float>(slope / solver.dot_of(direction, a));
    add(step_length, direction, x);
    add(-step_length, a, residual);
  }
  return 200;
}

TEST(MultigridConvergence, RateOnUniformSurfacesDoesNotDependOnSize) {
  for (const int n : {17, 33, 65, 129, 257})
    for (const Cloth& cloth : {glued_square(n, no_mates(n)), glued_square(n, torus_mates(n))}) {
      EXPECT_LT(convergence_factor(cloth, 2), 0.17) << n << ", " << cloth.particles << " particles";
      EXPECT_LT(convergence_factor(cloth, 1), 0.28) << n << ", " << cloth.particles << " particles";
    }
}

/// All corners and middles of sides are one point with three whole turns around it. Fields bend
/// there as the cube root of the distance does, which the coarse levels see less well.
TEST(MultigridConvergence, OnePointOfThreeTurnsCostsSomeRateButDoesNotAddUp) {
  for (const int n : {17, 33, 65, 129, 257}) {
    const Cloth cloth = glued_square(n, double_torus_mates(n));
    EXPECT_LT(convergence_factor(cloth, 2), 0.3) << n;
    EXPECT_LE(iterations_of(cloth), 6) << n;
  }
}

TEST(MultigridConvergence, IterationsDoNotGrowWithSizeUnderPins) {
  const auto hung = [](int n, const BorderMates& mates) {
    Cloth cloth = glued_square(n, mates);
    for (const int s : {0, n - 1, (n / 2) * n + n / 2})
      pin(cloth, s, vec_cast<double>(cloth.rest.at(s)));
    return iterations_of(cloth);
  };
  for (const int n : {17, 33, 65, 129, 257}) {
    EXPECT_LE(hung(n, no_mates(n)), 6) << n;
    EXPECT_LE(hung(n, torus_mates(n)), 6) << n;
  }
}

TEST(MultigridConvergence, IterationsDoNotGrowWithSizeOnATShirt) {
  std::vector<int> counts;
  for (const int n : {65, 129, 257}) {
    ConvertOptions options;
    options.size = n;
    const LoadedSurface shirt = load_surface("builtin:tshirt", options);
    Planes3 rest(n);
    for (int s = 0; s < n * n; ++s)
      rest.set(s, vec_cast<float>(shirt.image.world_position(s / n, s % n)));
    counts.push_back(iterations_of(make_cloth(rest, shirt.image.mates, soft_fabric)));
  }
  for (const int count : counts) EXPECT_LE(count, 14);
}

}  // namespace
}  // namespace weft
