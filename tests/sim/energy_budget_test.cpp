#include "weft/sim/stepping/energy_budget.h"

#include <gtest/gtest.h>

#include "tests/sim/made_up_step.h"

namespace weft {
namespace {

using testing::MadeUpStep;
using Drive = EnergyBudget::Drive;

TEST(EnergyBudget, NothingIsTakenOutOfAStepThatAddsNothing) {
  MadeUpStep step;
  const EnergyBudget::Added added = step.budget.measure_added({0}, Drive::bodies);
  EXPECT_NEAR(added.energy, 0, 1e-9);
  EXPECT_EQ(added.excess, 0);
  EXPECT_FALSE(added.too_much);
  EXPECT_TRUE(added.calm);
}

TEST(EnergyBudget, TakesOutWhatIsBeyondTheBoundAndKeepsMomentum) {
  MadeUpStep step;
  const double before = step.total();
  const double more = 0.05 * step.mass();
  ASSERT_GT(more, step.lent());
  step.add(more);
  const Vec3d momentum = step.momentum_now();
  const EnergyBudget::Added added = step.budget.measure_added({0}, Drive::bodies);
  EXPECT_NEAR(added.energy, more, 1e-5);
  EXPECT_NEAR(added.excess, more - step.lent(), 1e-5);
  EXPECT_FALSE(added.too_much);
  step.budget.take_out(added.excess);
  EXPECT_NEAR(step.total() - before, step.lent(), 1e-5);
  EXPECT_LT(length(step.momentum_now() - momentum), 1e-6);
}

TEST(EnergyBudget, WorkExplainsWhatItAdds) {
  MadeUpStep step;
  const double more = 0.05 * step.mass();
  step.add(more);
  EXPECT_EQ(step.budget.measure_added({more}, Drive::bodies).excess, 0);
  EXPECT_EQ(step.budget.measure_added({0}, Drive::seams).excess, 0);  // seams that are sewn
}

TEST(EnergyBudget, PinsAndBodiesDoNoMoreThroughTheFilterThanItAdds) {
  MadeUpStep step;
  EXPECT_NEAR(step.budget.measure_added({1, 5}, Drive::bodies).work, 1, 1e-9);
  EXPECT_NEAR(step.budget.measure_added({1, -5}, Drive::bodies).work, 1, 1e-9);
  const double more = 0.05 * step.mass();
  step.add(more);
  EXPECT_NEAR(step.budget.measure_added({1, 5}, Drive::bodies).work, 1 + more, 1e-5);
  EXPECT_NEAR(step.budget.measure_added({1, 0.5 * more}, Drive::bodies).work, 1 + 0.5 * more, 1e-5);
  EXPECT_EQ(step.budget.measure_added({1, -5}, Drive::bodies).work, 1);
}

TEST(EnergyBudget, TellsStepsThatAddTooMuch) {
  MadeUpStep step;
  step.add(step.mass());
  EXPECT_TRUE(step.budget.measure_added({0}, Drive::bodies).too_much);
  EXPECT_FALSE(step.budget.measure_added({0}, Drive::seams).too_much);
  EXPECT_FALSE(step.budget.measure_added({step.mass()}, Drive::bodies).too_much);
}

/// What a step adds after whose solve all springs are stretched.
EnergyBudget::Added stretched(float factor, Drive drive) {
  MadeUpStep step;
  step.stretch(factor);
  return step.budget.measure_added({0}, drive);
}

TEST(EnergyBudget, TellsStepsThatStretchSpringsWildly) {
  EXPECT_TRUE(stretched(1.01F, Drive::bodies).too_much);
  EXPECT_FALSE(stretched(1.01F, Drive::bodies).wild);
  EXPECT_TRUE(stretched(1.5F, Drive::bodies).wild);
  MadeUpStep faster;
  faster.add(10 * faster.mass());
  EXPECT_TRUE(faster.budget.measure_added({0}, Drive::bodies).too_much);
  EXPECT_FALSE(faster.budget.measure_added({0}, Drive::bodies).wild);
}

/// Seams may gain what they like, but cloth that they pull through other cloth is torn by the
/// filter.
TEST(EnergyBudget, WhileSeamsAreSewnWildStretchingAloneIsTooMuch) {
  EXPECT_TRUE(stretched(1, Drive::seams).calm);
  EXPECT_FALSE(stretched(1.01F, Drive::seams).too_much);
  const EnergyBudget::Added torn = stretched(1.5F, Drive::seams);
  EXPECT_TRUE(torn.too_much);
  EXPECT_FALSE(torn.calm);
  EXPECT_EQ(torn.excess, 0);
}

TEST(EnergyBudget, WhatASolveGainsCountsWhereNothingMovesTheCloth) {
  MadeUpStep step;
  step.stretch(1.05F, true);
  const double gained = step.total() - step.at_start();
  ASSERT_GT(gained, step.lent());
  EXPECT_EQ(step.budget.measure_added({0}, Drive::bodies).excess, 0);
  const EnergyBudget::Added added = step.budget.measure_added({0}, Drive::none);
  EXPECT_NEAR(added.excess, gained - step.lent(), 1e-4 * gained);
  EXPECT_TRUE(added.unpaid);
  EXPECT_TRUE(added.too_much);
}

TEST(EnergyBudget, AStepIsShortenedUntilMotionPaysWhatItGains) {
  for (const float factor : {1.05F, 1.5F, 20.0F}) {
    MadeUpStep step;
    step.stretch(factor);
    const double moved = step.moved();
    ASSERT_TRUE(step.budget.measure_added({0}, Drive::none).unpaid);
    const EnergyBudget::Added added = step.budget.shorten({0});
    EXPECT_FALSE(added.unpaid);
    EXPECT_NEAR(step.moved(), added.gone * moved, 1e-3 * moved);
    EXPECT_LT(step.moved(), 0.6 * moved);
    if (added.excess > 0) step.budget.take_out(added.excess);
    EXPECT_LE(step.total(), step.at_start() + 1.3 * step.lent()) << factor;
  }
}

TEST(EnergyBudget, AStepThatGainsFromItsBeginningIsNotGone) {
  MadeUpStep step;
  step.stretch(20);
  EXPECT_EQ(step.budget.shorten({0}).excess, 0);
  EXPECT_EQ(step.moved(), 0);
  EXPECT_EQ(length(step.momentum_now()), 0);
}

TEST(EnergyBudget, ASolveThatMissedMuchIsLostWhereTheStepMayBeShorter) {
  MadeUpStep step;
  EXPECT_FALSE(step.budget.solve_is_lost(1));
  step.miss(step.mass());
  EXPECT_TRUE(step.budget.solve_is_lost(1));
  EXPECT_TRUE(step.budget.solve_is_lost(0.25));
  EXPECT_FALSE(step.budget.solve_is_lost(0.125));
  step.miss(1e-3 * step.mass());
  EXPECT_FALSE(step.budget.solve_is_lost(1));
}

TEST(EnergyBudget, CountsWorkWithAndWithoutItsSign) {
  MadeUpStep step;
  step.budget.finish_step(2, true);
  step.budget.finish_step(-3, true);
  step.budget.add_pulled(0.5);
  EXPECT_EQ(step.budget.work().net, -1);
  EXPECT_EQ(step.budget.work().gross, 5);
  EXPECT_EQ(step.budget.work().pulled, 0.5);
}

}  // namespace
}  // namespace weft
