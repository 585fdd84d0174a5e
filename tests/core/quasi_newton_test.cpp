#include "weft/core/quasi_newton.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

/// The valley of Rosenbrock in each point, lowest at (1, 1).
double valley(const Vectors& at, Vectors& gradient) {
  double sum = 0;
  for (std::size_t k = 0; k < at.size(); ++k) {
    const double across = at[k].y - at[k].x * at[k].x, along = 1 - at[k].x;
    sum += 100 * across * across + along * along;
    gradient[k] = {-400 * across * at[k].x - 2 * along, 200 * across};
  }
  return sum;
}

TEST(QuasiNewton, DescendsACurvedValleyToItsLowestPoint) {
  Vectors at{{-1.2, 1}, {0, 0}, {2, 2}};
  EXPECT_LT(descend(valley, at, {.max_steps = 200}), 1e-8);
  for (const Vec2d p : at) EXPECT_LT(length(p - Vec2d{1, 1}), 1e-4);
}

TEST(QuasiNewton, NeverGoesUpHoweverFewSteps) {
  for (int steps = 0; steps < 12; ++steps) {
    Vectors at{{-1.2, 1}}, more = at, unused(1);
    const double before = descend(valley, at, {.max_steps = steps});
    EXPECT_LE(descend(valley, more, {.max_steps = steps + 1}), before) << steps;
    EXPECT_EQ(valley(at, unused), before);
  }
}

TEST(QuasiNewton, StaysAtAMinimum) {
  Vectors at{{1, 1}};
  EXPECT_EQ(descend(valley, at, {}), 0);
  EXPECT_EQ(at[0], (Vec2d{1, 1}));
}

}  // namespace
}  // namespace weft
