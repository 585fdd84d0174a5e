// The linear systems of the default method: operator, cycle, seams, factors of lines.
#include "tests/cloth/newton_system.h"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "weft/cloth/newton/line_factor.h"
#include "weft/cloth/newton/newton_solver.h"
#include "weft/cloth/newton/seams.h"

namespace weft {
namespace {

using namespace testing;

/// The sides of a square a b a' b' c d c' d' in eighths: a closed surface of genus 2.
BorderMates double_torus_mates(int n) {
  const int half = (n - 1) / 2;
  return {n,
          {{0, 3 * half, half},
           {half, 4 * half, half},
           {4 * half, 7 * half, half},
           {5 * half, 8 * half, half}}};
}

TEST(Newton, TheCycleIsPositive) {
  Cloth pinned = sheet_cloth(33, cotton);
  hang(pinned);
  const Cloth double_torus = make_cloth(flat_sheet(33), double_torus_mates(33), cotton);
  for (const Cloth& cloth : {pinned, sheet_cloth(30, hard), torus_cloth(33, woven),
                             torus_cloth(20, cotton), double_torus}) {
    System system(cloth);
    PaddedVectors product(cloth.size, cloth.size);
    for (const int seed : {1, 2, 3}) {
      // Of smooth fields and of rough ones.
      const PaddedVectors rough = system.random_field(seed);
      EXPECT_GT(system.dot(rough, system.cycle(rough)), 0) << cloth.size;
      system.times(rough, product);
      EXPECT_GT(system.dot(product, system.cycle(product)), 0) << cloth.size;
    }
  }
}

TEST(Newton, FreeCornersOfStiffClothLeaveTheCyclePositive) {
  // What the smoother does not know of borders grows there from cycle to cycle.
  const Cloth cloth =
      sheet_cloth(25, {.density = 0.2, .stretch = 20000, .shear = 5000, .bending = 1});
  System system(cloth, 0);
  PaddedVectors residual = system.random_field(1), product(25, 25);
  for (int i = 0; i < 30; ++i) {
    const PaddedVectors& value = system.cycle(residual);
    EXPECT_GT(system.dot(residual, value), 0) << i;
    system.times(value, product);
    system.blend(-1, product, 1, residual);
    const double size = std::sqrt(system.dot(residual, residual));
    system.blend(0, product, static_cast<float>(1 / size), residual);
  }
}

TEST(Newton, TheOperatorIsTheDerivativeOfTheForces) {
  for (const Cloth& cloth : {sheet_cloth(17, Material{.density = 0.2,
                                             .stretch = 300,
                                             .shear = 100,
                                             .bending = 1e-3,
                                             .bend_springs = 20,
                                             .damping = 0})}) {
    // Stretched, so that all of the true Hessian counts.
    Planes3 stretched = cloth.rest;
    for (int s = 0; s < cloth.size * cloth.size; ++s) stretched.set(s, 1.3F * stretched.at(s));
    System system(cloth, 0);
    PaddedState& state = system.state;
    const PaddedVectors direction = system.random_field(3);
    const Planes3 still(cloth.size);
    const auto forces_at = [&](float length, PaddedVectors& out) {
      for (int r = 0; r < cloth.size; ++r)
        for (int c = 0; c < cloth.size; ++c) {
          const Vec3f p = stretched.at(r, c);
          state.position.x(r, c) = p.x + length * direction.x(r, c);
          state.position.y(r, c) = p.y + length * direction.y(r, c);
          state.position.z(r, c) = p.z + length * direction.z(r, c);
          state.start.x(r, c) = p.x;
          state.start.y(r, c) = p.y;
          state.start.z(r, c) = p.z;
          state.velocity.x(r, c) = static_cast<float>(length / step) * direction.x(r, c);
          state.velocity.y(r, c) = static_cast<float>(length / step) * direction.y(r, c);
          state.velocity.z(r, c) = static_cast<float>(length / step) * direction.z(r, c);
        }
      system.team.run([&](Worker& worker) {
        system.multigrid.linearise({state, still, {}, 0.1F}, nullptr, system.springs, out, worker);
      });
    };
    constexpr float small = 2e-4F;
    PaddedVectors ahead(cloth.size, cloth.size), behind(cloth.size, cloth.size),
        product(cloth.size, cloth.size);
    forces_at(small, ahead);
    forces_at(-small, behind);
    forces_at(0, product);
    system.times(direction, product);
    system.blend(-0.5F / small, behind, 0.5F / small, ahead);
    const double size = std::sqrt(system.dot(product, product));
    system.blend(1, product, 1, ahead);
    EXPECT_LT(std::sqrt(system.dot(ahead, ahead)), 0.01 * size);
  }
}

TEST(Newton, IterationsDoNotGrowWithTheImage) {
  for (const Material& material : {cotton, hard, woven}) {
    int max = 0, small = 0;
    for (const int n : {33, 50, 65, 129}) {
      Cloth cloth = sheet_cloth(n, material);
      hang(cloth);
      max = std::max(max, System(cloth).iterations_to_a_hundredth());
      if (n == 33) small = max;
    }
    // Of cycles that solve each line once.
    EXPECT_LE(max, 12);
    EXPECT_LE(max, small + 3);
  }
}

TEST(Newton, SeamsCostFewIterations) {
  for (const int n : {33, 40, 65}) {
    const Cloth around = torus_cloth(n, cotton);
    EXPECT_LE(System(around).iterations_to_a_hundredth(), 14) << n;
  }
  const Cloth glued = make_cloth(flat_sheet(65), double_torus_mates(65), cotton);
  EXPECT_LE(System(glued).iterations_to_a_hundredth(), 12);
}

/// A field of blocks t 1 + s s^T by chance, along rows or down columns, none after the last sample.
struct RandomSprings {
  PaddedPlane t, x, y, z;
  RandomSprings(int n, bool along_rows, double stiffness, Random& random)
      : t(n, n), x(n, n), y(n, n), z(n, n) {
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) {
        if ((along_rows ? c : r) == n - 1) continue;
        t(r, c) = static_cast<float>(random.uniform(0, 0.01 * stiffness));
        for (PaddedPlane* plane : {&x, &y, &z})
          (*plane)(r, c) = static_cast<float>(std::sqrt(stiffness) * random.uniform(-0.6, 0.6));
      }
  }
  [[nodiscard]] std::array<double, 6> block(int r, int c) const {
    const double a = x(r, c), b = y(r, c), d = z(r, c), across = t(r, c);
    return {across + a * a, a * b, a * d, across + b * b, b * d, across + d * d};
  }
};

PlaneView view_of(const PaddedPlane& plane) { return {plane.row(0), plane.stride()}; }

/// The same lines, factored as springs in series and as blocks.
double difference_of_factors(int n, bool along_rows, double stiffness, InstructionSet set) {
  Random random(11);
  const NewtonKernels& kernels = newton_kernels_for(set);
  const RandomSprings springs(n, along_rows, stiffness, random);
  PlaneSet held(n, n, block_entries), whole(n, n, block_entries), coupling(n, n, block_entries);
  PaddedPlane extra(n, n);
  PaddedVectors rhs(n, n), one(n, n), other(n, n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const auto after = springs.block(r, c);
      const auto before = (along_rows ? c : r) == 0
                              ? std::array<double, 6>{}
                              : springs.block(along_rows ? r : r - 1, along_rows ? c - 1 : c);
      for (int k = 0; k < 6; ++k) {
        const double own =
            k == 0 || k == 3 || k == 5 ? random.uniform(2, 5) : random.uniform(-1, 1);
        held(r, c, k) = static_cast<float>(own);
        whole(r, c, k) = static_cast<float>(own + after[k] + before[k]);
        coupling(r, c, k) = static_cast<float>(-after[k]);
      }
      rhs.x(r, c) = static_cast<float>(random.uniform(-1, 1));
      rhs.y(r, c) = static_cast<float>(random.uniform(-1, 1));
      rhs.z(r, c) = static_cast<float>(random.uniform(-1, 1));
    }
  HeldLineMatrix series{
      {}, {view_of(springs.t), view_of(springs.x), view_of(springs.y), view_of(springs.z)}};
  LineMatrix blocks{{}, view_of(extra), {}};
  for (int k = 0; k < 6; ++k) {
    series.held[k] = held.view(k);
    blocks.diagonal[k] = whole.view(k);
    blocks.coupling[k] = coupling.view(k);
  }
  LineFactor as_series(n, along_rows, true), as_blocks(n, along_rows, false);
  std::vector<float> scratch(LineFactor::scratch_size(n));
  for (int b = 0; b < as_series.blocks(); ++b) {
    as_series.factor(b, series, kernels);
    as_blocks.factor(b, blocks, kernels);
    as_series.solve(b, rhs, {}, scratch.data(), one, kernels);
    as_blocks.solve(b, rhs, {}, scratch.data(), other, kernels);
  }
  double largest = 0, apart = 0;
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c)
      for (const auto plane : {&PaddedVectors::x, &PaddedVectors::y, &PaddedVectors::z}) {
        const double a = (one.*plane)(r, c), b = (other.*plane)(r, c);
        largest = std::max(largest, std::abs(b));
        apart = std::max(apart, std::abs(a - b));
      }
  return apart / largest;
}

TEST(Newton, SpringsInSeriesAreSolvedAsTheirBlocks) {
  for (const InstructionSet set : instruction_sets())
    for (const int n : {7, 20, 33, 50})
      for (const bool along_rows : {true, false}) {
        if (!has_instruction_set(set)) continue;
        EXPECT_LT(difference_of_factors(n, along_rows, 10, set), 1e-4) << n << ", " << along_rows;
        EXPECT_LT(difference_of_factors(n, along_rows, 1e4, set), 0.02) << n << ", " << along_rows;
      }
}

}  // namespace
}  // namespace weft
