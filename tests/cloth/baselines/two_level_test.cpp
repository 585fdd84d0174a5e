#include <numeric>

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "weft/cloth/baselines/filter_matrix.h"
#include "weft/cloth/baselines/filtered_integrator.h"
#include "weft/cloth/baselines/paper_filters.h"
#include "weft/cloth/baselines/spring_matrix.h"
#include "weft/cloth/integrator.h"
#include "weft/cloth/measure.h"

namespace weft {
namespace {

using namespace testing;

FilterGrid patch(int n, double ratio) {
  FilterGrid grid;
  grid.size = n;
  grid.particle_of.resize(static_cast<std::size_t>(n) * n);
  std::iota(grid.particle_of.begin(), grid.particle_of.end(), 0);
  grid.mass.assign(grid.particle_of.size(), 1.0);
  for (Grid<double>& plane : grid.stiffness) plane = Grid<double>(n, n, ratio);
  grid.time_step = 1;
  return grid;
}

Grid<float> matrix_of(const FilterGrid& grid) {
  ThreadTeam team(2);
  return filter_matrix(grid, team);
}

GlobalFilter global_filter(const Cloth& cloth, const GlobalFilter::Options& options) {
  ThreadTeam team(2);
  return {cloth, options, team};
}

void expect_rows_of_one(const Grid<float>& w, const std::vector<double>& mass) {
  const int count = static_cast<int>(mass.size());
  for (int i = 0; i < count; ++i) {
    double sum = 0;
    for (int j = 0; j < count; ++j) {
      sum += w(i, j);
      EXPECT_NEAR(mass[i] * w(i, j), mass[j] * w(j, i), 1e-6 * mass[i]);
    }
    EXPECT_NEAR(sum, 1, 1e-5);
  }
}

TEST(TwoLevel, RowsOfTheLocalMatrixSumToOneAndItIsSymmetric) {
  const FilterGrid grid = patch(7, 0.3);
  const Grid<float> w = matrix_of(grid);
  expect_rows_of_one(w, grid.mass);
  EXPECT_LT(w(24, 24), 0.5);
  EXPECT_GT(w(24, 25), 0.01);
}

TEST(TwoLevel, RowsOfTheGlobalMatrixSumToOneAndMassTimesItIsSymmetric) {
  for (const Cloth& cloth : {sheet_cloth(17), torus_cloth(17)}) {
    const GlobalFilter filter =
        global_filter(cloth, {.size = 5, .stiffness = 100, .time_step = 1.0 / 60});
    expect_rows_of_one(filter.matrix(), filter.masses());
    EXPECT_NEAR(std::accumulate(filter.masses().begin(), filter.masses().end(), 0.0),
                total_mass(cloth), 1e-6);
  }
  const GlobalFilter merged =
      global_filter(torus_cloth(17), {.size = 5, .stiffness = 1, .time_step = 1.0 / 60});
  EXPECT_EQ(merged.masses().size(), 16U);
}

TEST(TwoLevel, FilterWithMassesIsTheInverseOfItsSystem) {
  // Two particles on one spring: W = ((m1 + k, -k), (-k, m2 + k))^-1 diag(m1, m2), by hand.
  FilterGrid grid = patch(2, 0);
  grid.particle_of = {0, 1, 0, 1};
  grid.mass = {1, 3};
  grid.stiffness[stretch_u](0, 0) = 0.5;
  const Grid<float> w = matrix_of(grid);
  const double determinant = 1.5 * 3.5 - 0.25;
  EXPECT_NEAR(w(0, 0), 3.5 / determinant, 1e-6);
  EXPECT_NEAR(w(0, 1), 0.5 * 3 / determinant, 1e-6);
  EXPECT_NEAR(w(1, 0), 0.5 / determinant, 1e-6);
  EXPECT_NEAR(w(1, 1), 1.5 * 3 / determinant, 1e-6);
}

TEST(TwoLevel, SlidingPatchTakesTheRowOfItsPlace) {
  const int n = 23, size = 5;
  const double ratio = 0.4;
  const Grid<float> w = matrix_of(patch(size, ratio));
  ThreadTeam team(1);
  LocalFilter filter(n, size, ratio, team);
  Planes3 in(n), out(n);
  shake(sheet_cloth(n), 1, in);
  team.run([&](Worker& worker) {
    for (int r = 0; r < n; ++r) filter.apply_row(in, out, r, worker);
  });
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const int top = std::clamp(r - 2, 0, n - size), left = std::clamp(c - 2, 0, n - size);
      double sum = 0;
      for (int k = 0; k < size; ++k)
        for (int l = 0; l < size; ++l)
          sum += double{w((r - top) * size + c - left, k * size + l)} * in.y(top + k, left + l);
      ASSERT_NEAR(out.y(r, c), sum, 1e-5) << "row " << r << ", col " << c;
    }
}

TEST(TwoLevel, GlobalFilterLeavesUniformFieldsAlone) {
  const Cloth cloth = torus_cloth(17);
  for (const bool difference : {true, false}) {
    GlobalFilter filter = global_filter(
        cloth, {.size = 5, .stiffness = 100, .time_step = 1.0 / 60, .difference = difference});
    Planes3 in(17), out(17);
    in.y.fill(2);
    ThreadTeam team(2);
    team.run([&](Worker& worker) { filter.filter(in, worker); });
    for (int r = 0; r < 17; ++r) filter.add_row(out, r);
    for (int r = 0; r < 17; ++r)
      for (int c = 0; c < 17; ++c) EXPECT_NEAR(out.y(r, c), difference ? 0 : 2, 1e-5);
  }
}

/// W of the whole cloth with the springs of two_level, by one dense matrix.
Grid<float> exact_filter(const Cloth& cloth, double ratio) {
  const int n = cloth.size;
  FilterGrid grid = patch(n, 0);
  for (int s = 0; s < n * n; ++s) grid.mass[s] = cloth.mass(s / n, s % n);
  for (int d = 0; d < spring_directions; ++d)
    mass_springs(
        spring_offsets[d], ratio, [&](int r, int c) { return double{cloth.mass(r, c)}; },
        grid.stiffness[d]);
  return matrix_of(grid);
}

TEST(TwoLevel, FiltersAsTheExactMatrixDoesWherePrintedDoublesSmoothFields) {
  const int n = 21;
  const double ratio = 0.1, step = 1.0 / 60;
  const Cloth cloth = sheet_cloth(n);
  const double stiffness = ratio * total_mass(cloth) / cloth.particles / (step * step);
  const Grid<float> exact = exact_filter(cloth, ratio);
  ThreadTeam team(2);
  LocalFilter local(n, 9, ratio, team);
  // Relative to the exact result, of a field with `waves` waves a side.
  const auto error = [&](double waves, bool as_printed) {
    GlobalFilter global(
        cloth, {.size = 6, .stiffness = stiffness, .time_step = step, .difference = !as_printed},
        team);
    Planes3 in(n), out(n);
    for (int s = 0; s < n * n; ++s)
      in.set(s, {0, static_cast<float>(sine(2 * pi * waves * (s % n) / (n - 1) + 1)), 0});
    team.run([&](Worker& worker) {
      const Range mine = worker.share(n);
      for (int r = mine.first; r < mine.last; ++r) local.apply_row(in, out, r, worker);
      worker.barrier();
      global.filter(out, worker);
      worker.barrier();
      for (int r = mine.first; r < mine.last; ++r) global.add_row(out, r);
    });
    double wrong = 0, size = 0;
    for (int i = 0; i < n * n; ++i) {
      double right = 0;
      for (int j = 0; j < n * n; ++j) right += double{exact(i, j)} * in.at(j).y;
      wrong += (out.at(i).y - right) * (out.at(i).y - right);
      size += right * right;
    }
    return std::sqrt(wrong / size);
  };
  for (const double waves : {0.5, 1.0, 2.0}) {
    EXPECT_LT(error(waves, false), 0.06) << waves;
    EXPECT_GT(error(waves, true), 0.6) << waves;
  }
}

Moments moments_of(const Cloth& cloth, const Planes3& x, const Planes3& a) {
  Moments result;
  ThreadTeam team(1);
  MomentSums sums(cloth.size, team);
  team.run([&](Worker& worker) { result = sums.sum(cloth, x, a, worker); });
  return result;
}

TEST(TwoLevel, CorrectionCancelsNetForceAndTorque) {
  for (const Cloth& cloth : {sheet_cloth(9), torus_cloth(9)}) {
    Planes3 x = cloth.rest, a(9);
    for (int s = 0; s < 81; ++s) x.set(s, x.at(s) + Vec3f{3, -1, 2});
    shake(cloth, 1, a);
    const Moments before = moments_of(cloth, x, a);
    const RigidAcceleration rigid = momentum_correction(before);
    for (int s = 0; s < 81; ++s)
      a.set(s,
            a.at(s) + vec_cast<float>(rigid.linear +
                                      cross(vec_cast<double>(x.at(s)) - rigid.centre, rigid.turn)));
    const Moments after = moments_of(cloth, x, a);
    EXPECT_GT(length(before.torque), 1e-3);
    EXPECT_LT(length(after.force), 1e-5 * length(before.force));
    EXPECT_LT(length(after.torque), 1e-5 * length(before.torque));
  }
}

TEST(TwoLevel, KeepsAngularMomentumWherePrintedDoesNot) {
  const int n = 17;
  const Cloth cloth = sheet_cloth(n);
  ThreadTeam team(1);
  const StepInput input{1.0 / 240, {}};
  const auto drift = [&](bool as_printed) {
    const auto integrator = make_integrator(
        TwoLevelOptions{.local_size = 5, .as_printed = as_printed}, cloth, input, team);
    ClothState state = rest_state(cloth);
    shake(cloth, 0.005, state.position);
    for (int i = 0; i < 20; ++i) {
      integrator->begin(input, state);
      integrator->iterate({});
      integrator->end(state);
    }
    const double scale = std::sqrt(2 * kinetic_energy(cloth, state) * total_mass(cloth));
    return length(angular_momentum(cloth, state)) / scale;
  };
  EXPECT_LT(drift(false), 1e-3);
  EXPECT_GT(drift(true), 3 * drift(false));
}

TEST(TwoLevel, TooStiffAFilterGrowsAndTheAdviceNamesTheStiffness) {
  const Cloth cloth = sheet_cloth(33);
  ThreadTeam team(1);
  const StepInput input{1.0 / 240, {}};
  const double mass = total_mass(cloth) / cloth.particles;
  const auto energy_after = [&](double ratio) {
    TwoLevelOptions options{.local_size = 5};
    options.filter_stiffness = ratio * mass / (input.time_step * input.time_step);
    const auto integrator = make_integrator(options, cloth, input, team);
    ClothState state = rest_state(cloth);
    shake(cloth, 1e-4, state.position);
    for (int i = 0; i < 100; ++i) {
      integrator->begin(input, state);
      integrator->iterate({});
      integrator->end(state);
    }
    return kinetic_energy(cloth, state);
  };
  EXPECT_LT(energy_after(0.09), 1e-4);
  EXPECT_FALSE(energy_after(0.94) < 1);  // or not a number any more
  const auto integrator = make_integrator(TwoLevelOptions{.local_size = 5}, cloth, input, team);
  EXPECT_NE(integrator->stability_advice(1.0 / 240).find("filter_stiffness"), std::string::npos);
}

}  // namespace
}  // namespace weft
