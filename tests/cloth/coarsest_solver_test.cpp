#include "weft/cloth/newton/coarsest_solver.h"

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"

namespace weft {
namespace {

using namespace testing;

constexpr int n = 3;

BlockLevel level_of(const Cloth& cloth) {
  const LevelLayout layout(cloth.mates);
  return {{layout, false, 1}, Seams(cloth.mates, layout), BendingStencil{}};
}

/// @param block  of the stencil: centre, right, below
void put(BlockLevel& level, int block, int sample, double value) {
  for (const int entry : {0, 3, 5})
    level.stencil(sample / n, sample % n, block * block_entries + entry) =
        static_cast<float>(value);
}

void set_all(PaddedPlane& plane, double value) {
  for (int s = 0; s < n * n; ++s) plane(s / n, s % n) = static_cast<float>(value);
}

/// Nine samples on springs of chance between neighbours, with a mass each: what the sum of the
/// masses holds is about as large as what all diagonals together are rounded by.
void fill(BlockLevel& level, double mass, Random& random) {
  double diagonal[n * n] = {};
  const auto couple = [&](int block, int from, int to) {
    const double stiffness = static_cast<float>(random.uniform(0.5, 1.5));
    put(level, block, from, -stiffness);
    diagonal[from] += stiffness;
    diagonal[to] += stiffness;
  };
  for (int s = 0; s < n * n; ++s) {
    if (s % n + 1 < n) couple(1, s, s + 1);
    if (s + n < n * n) couple(2, s, s + n);
  }
  for (int s = 0; s < n * n; ++s) put(level, 0, s, diagonal[s] + mass);
}

TEST(CoarsestSolver, RoundedEntriesMoveNothingFartherThanTheExactOnes) {
  const Cloth cloth = sheet_cloth(n);
  Random random(5);
  for (int trial = 0; trial < 200; ++trial) {
    BlockLevel level = level_of(cloth);
    const double mass = 2e-8;
    fill(level, mass, random);
    CoarsestSolver solver(level);
    ASSERT_TRUE(solver.active());
    set_all(level.rhs.x, mass);
    solver.factor(level);
    solver.solve(level);
    // All go along by 1.
    for (int s = 0; s < n * n; ++s) {
      EXPECT_GE(level.value.x(s / n, s % n), 0) << trial;
      EXPECT_LT(level.value.x(s / n, s % n), 1.01F) << trial;
    }
  }
}

TEST(CoarsestSolver, SolvesWhatIsNotLostInRounding) {
  const Cloth cloth = sheet_cloth(n);
  Random random(6);
  BlockLevel level = level_of(cloth);
  fill(level, 0.01, random);
  CoarsestSolver solver(level);
  set_all(level.rhs.y, 0.01);
  solver.factor(level);
  solver.solve(level);
  for (int s = 0; s < n * n; ++s) EXPECT_NEAR(level.value.y(s / n, s % n), 1, 1e-3);
}

}  // namespace
}  // namespace weft
