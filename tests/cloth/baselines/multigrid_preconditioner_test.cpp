#include "weft/cloth/baselines/multigrid/multigrid_preconditioner.h"

#include <gtest/gtest.h>

#include "tests/cloth/baselines/filter_residual.h"
#include "tests/cloth/sheets.h"
#include "weft/cloth/mates.h"

namespace weft::multigrid_preconditioner_test {
namespace {

using namespace testing;

constexpr double frame = 1.0 / 60;

/// A filter beside the operator that it inverts.
struct Filter {
  explicit Filter(const Cloth& of, int sweeps = 1)
      : cloth(of), levels(make_filter_levels(of, frame)), filter(of, {frame, sweeps}, team) {
    renew_weights(levels, Grid<float>(of.size, of.size, 1));
    for (int s = 0; s < of.size * of.size; ++s)
      if (of.inverse_mass(s / of.size, s % of.size) == 0) held.push_back(s);
  }

  /// Own part of b - A x, 0 where held. @param b  own part too
  Planes3 residual(const Planes3& b, const Planes3& x) {
    Planes3 out = filter_residual(levels.front(), b, x);
    for (const int s : held) out.set(s, {});
    return out;
  }
  Planes3 apply(Planes3 own) {
    sum_over_mates(cloth.mates, {&own.x, &own.y, &own.z});
    filter.rhs() = own;
    team.run([&](Worker& worker) { slope = filter.cycle(worker); });
    return filter.value();
  }

  const Cloth& cloth;
  std::vector<FilterLevel> levels;
  ThreadTeam team{1};
  MultigridPreconditioner filter;
  double slope = 0;
  std::vector<int> held;
};

Planes3 sum_of(const Planes3& a, const Planes3& b) {
  Planes3 out(a.size());
  for (int s = 0; s < a.size() * a.size(); ++s) out.set(s, a.at(s) + b.at(s));
  return out;
}

double dot_of(const Planes3& a, const Planes3& b) {
  double sum = 0;
  for (int s = 0; s < a.size() * a.size(); ++s)
    sum += dot(vec_cast<double>(a.at(s)), vec_cast<double>(b.at(s)));
  return sum;
}

/// How much of the error in A's norm one of many cycles leaves.
double convergence_factor(const Cloth& cloth, int sweeps) {
  Filter filter(cloth, sweeps);
  const Planes3 zero(cloth.size);
  Planes3 x(cloth.size);
  shake(cloth, 1, x);
  for (const int s : filter.held) x.set(s, {});
  const auto energy = [&] { return -dot_of(filter.residual(zero, x), x); };
  const int cycles = 6;
  for (int i = 0; i < 2; ++i) x = sum_of(x, filter.apply(filter.residual(zero, x)));
  const double before = energy();
  for (int i = 0; i < cycles; ++i) x = sum_of(x, filter.apply(filter.residual(zero, x)));
  return std::pow(energy() / before, 0.5 / cycles);
}

Cloth hung(int n) {
  Cloth cloth = sheet_cloth(n);
  for (const int s : {0, n - 1}) pin(cloth, s, vec_cast<double>(cloth.rest.at(s)));
  return cloth;
}

TEST(MultigridPreconditioner, ConvergesAtARateThatDoesNotDependOnSize) {
  for (const int n : {17, 33, 65, 129}) {
    EXPECT_LT(convergence_factor(sheet_cloth(n), 1), 0.26) << n;
    EXPECT_LT(convergence_factor(sheet_cloth(n), 2), 0.16) << n;
  }
}

TEST(MultigridPreconditioner, ConvergesAsWellOnSizesThatHalveOnce) {
  for (const int n : {35, 71, 81}) EXPECT_LT(convergence_factor(sheet_cloth(n), 2), 0.16) << n;
}

TEST(MultigridPreconditioner, ConvergesWithPinsAndSeams) {
  for (const int n : {33, 65, 71}) {
    EXPECT_LT(convergence_factor(hung(n), 2), 0.4) << n;
    EXPECT_LT(convergence_factor(torus_cloth(n), 2), 0.6) << n;
  }
}

/// A^-1 b by Gaussian elimination on the particles, from the operator's columns.
Planes3 direct_solution(Filter& filter, const Planes3& own) {
  const Cloth& cloth = filter.cloth;
  const int n = cloth.size, samples = n * n;
  const Planes3 zero(n);
  std::vector<int> particles;
  for (int s = 0; s < samples; ++s)
    if (cloth.mates.representative(s) == s && cloth.inverse_mass(s / n, s % n) > 0)
      particles.push_back(s);
  const auto summed = [&](Planes3 planes) {
    sum_over_mates(cloth.mates, {&planes.x, &planes.y, &planes.z});
    return planes;
  };
  const int count = static_cast<int>(particles.size());
  Grid<double> rows(count, count + 3);
  for (int j = 0; j < count; ++j) {
    Planes3 unit(n);
    for (int s = 0; s < samples; ++s)
      if (cloth.mates.representative(s) == particles[j]) unit.set(s, {1, 0, 0});
    const Planes3 column = summed(filter.residual(zero, unit));
    for (int i = 0; i < count; ++i) rows(i, j) = -column.at(particles[i]).x;
  }
  const Planes3 right = summed(own);
  for (int i = 0; i < count; ++i) {
    const Vec3f b = right.at(particles[i]);
    rows(i, count) = b.x, rows(i, count + 1) = b.y, rows(i, count + 2) = b.z;
  }
  for (int i = 0; i < count; ++i)
    for (int k = 0; k < count; ++k) {
      if (k == i || rows(k, i) == 0) continue;
      const double factor = rows(k, i) / rows(i, i);
      for (int j = i; j < count + 3; ++j) rows(k, j) -= factor * rows(i, j);
    }
  Planes3 x(n);
  for (int s = 0; s < samples; ++s)
    for (int i = 0; i < count; ++i)
      if (cloth.mates.representative(s) == particles[i]) {
        const auto at = [&](int k) { return rows(i, count + k) / rows(i, i); };
        x.set(s, vec_cast<float>(Vec3d{at(0), at(1), at(2)}));
      }
  return x;
}

TEST(MultigridPreconditioner, ConvergesToTheDirectSolution) {
  for (const int n : {9, 17})
    for (const Cloth& cloth : {sheet_cloth(n), torus_cloth(n), hung(n)}) {
      Filter filter(cloth);
      Planes3 b(n);
      shake(cloth, 1, b);
      const Planes3 exact = direct_solution(filter, b);
      Planes3 x(n);
      for (int i = 0; i < 30; ++i) x = sum_of(x, filter.apply(filter.residual(b, x)));
      double size = 0, error = 0;
      for (int s = 0; s < n * n; ++s) {
        size = std::max(size, double{length(exact.at(s))});
        error = std::max(error, double{length(exact.at(s) - x.at(s))});
      }
      EXPECT_GT(size, 0);
      EXPECT_LT(error, 1e-4 * size) << n << ", " << cloth.particles << " particles";
    }
}

TEST(MultigridPreconditioner, SolvesSizesOfTheCoarsestLevelInOneCycle) {
  for (const Cloth& cloth : {sheet_cloth(8), torus_cloth(5), hung(36), torus_cloth(36)}) {
    const int n = cloth.size;
    Filter filter(cloth);
    Planes3 b(n);
    shake(cloth, 1, b);
    for (const int s : filter.held) b.set(s, {});
    Planes3 left = filter.residual(b, filter.apply(b)), whole = b;
    sum_over_mates(cloth.mates, {&left.x, &left.y, &left.z});
    sum_over_mates(cloth.mates, {&whole.x, &whole.y, &whole.z});
    EXPECT_LT(dot_of(left, left), 1e-8 * dot_of(whole, whole)) << n;
  }
}

TEST(MultigridPreconditioner, GivesAConstantAccelerationBack) {
  for (const Cloth& cloth : {sheet_cloth(33), torus_cloth(33), sheet_cloth(71)}) {
    const int n = cloth.size;
    Filter filter(cloth);
    const Vec3f move{0.5F, -1, 2};
    Planes3 b(n), x(n);
    for (int s = 0; s < n * n; ++s) b.set(s, filter.filter.mass_weight()(s / n, s % n) * move);
    for (int i = 0; i < 20; ++i) x = sum_of(x, filter.apply(filter.residual(b, x)));
    for (int s = 0; s < n * n; ++s) ASSERT_LT(length(x.at(s) - move), 1e-3) << n << ", " << s;
  }
}

TEST(MultigridPreconditioner, CycleIsSymmetric) {
  for (const int sweeps : {1, 2})
    for (const Cloth& cloth :
         {sheet_cloth(33), torus_cloth(33), hung(33), sheet_cloth(71), torus_cloth(71)}) {
      Filter filter(cloth, sweeps);
      Planes3 a(cloth.size), b(cloth.size);
      shake(cloth, 1, a, 1);
      shake(cloth, 1, b, 2);
      for (const int s : filter.held) a.set(s, {}), b.set(s, {});
      const double ab = dot_of(a, filter.apply(b)), ba = dot_of(b, filter.apply(a));
      const double scale = std::sqrt(dot_of(a, filter.apply(a)) * dot_of(b, filter.apply(b)));
      EXPECT_NEAR(ab, ba, 1e-4 * scale) << cloth.size;
      EXPECT_GT(scale, 0);
    }
}

TEST(MultigridPreconditioner, ForgetsPinsThatAreLetGo) {
  const Cloth cloth = sheet_cloth(17);
  Planes3 b(17);
  shake(cloth, 1, b);
  Filter fresh(cloth);
  const Planes3 free = fresh.apply(b);
  ThreadTeam team(1);
  MultigridPreconditioner filter(hung(17), {frame}, team);
  EXPECT_FALSE(filter.knows_pins(cloth));
  filter.renew_pins(cloth);
  EXPECT_TRUE(filter.knows_pins(cloth));
  filter.rhs() = b;
  team.run([&](Worker& worker) { filter.cycle(worker); });
  for (int s = 0; s < 17 * 17; ++s) ASSERT_EQ(filter.value().at(s), free.at(s));
}

}  // namespace
}  // namespace weft::multigrid_preconditioner_test
