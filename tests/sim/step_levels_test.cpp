#include <gtest/gtest.h>

#include "weft/sim/stepping/adaptive_substeps.h"

namespace weft {
namespace {

TEST(StepLevels, CalmSubstepsAreOneStep) {
  StepWalk walk(0, {});
  EXPECT_EQ(walk.subdivisions(), 1);
  walk.accept(StepVerdict::calm);
  EXPECT_TRUE(walk.done());
  EXPECT_EQ(walk.next({}), StepLevels{});
}

TEST(StepLevels, ARefusedStepBecomesTwoHalves) {
  StepWalk walk(0, {});
  walk.halve();
  walk.halve();
  EXPECT_EQ(walk.subdivisions(), 4);
  walk.accept(StepVerdict::near);
  EXPECT_EQ(walk.index(), 1);
  walk.accept(StepVerdict::calm);
  // Half is done, in calm: the other half is tried at once.
  EXPECT_EQ(walk.subdivisions(), 2);
  EXPECT_EQ(walk.index(), 1);
  walk.accept(StepVerdict::calm);
  EXPECT_TRUE(walk.done());
}

TEST(StepLevels, TheNextSubstepBeginsAsShortAndGrowsLonger) {
  StepLevels levels;
  StepWalk walk(0, levels);
  walk.halve();
  walk.halve();
  while (!walk.done()) walk.accept(StepVerdict::near);
  levels = walk.next(levels);
  EXPECT_EQ(levels.first, 2);
  for (const int first : {1, 0, 0}) {
    StepWalk calm(0, levels);
    EXPECT_EQ(calm.subdivisions(), 1 << levels.first);
    while (!calm.done()) calm.accept(StepVerdict::calm);
    levels = calm.next(levels);
    EXPECT_EQ(levels.first, first);
  }
}

TEST(StepLevels, WhereHalvingIsNoHelpItIsTriedLessAndLess) {
  StepLevels levels;
  for (const int most : {5, 4, 3, 2, 1, 1}) {
    StepWalk walk(0, levels);
    int steps = 0, refused = 0;
    while (!walk.done()) {
      if (walk.may_halve()) {
        walk.halve();
        ++refused;
      } else {
        walk.accept(StepVerdict::forced);
        ++steps;
      }
    }
    EXPECT_EQ(steps, 1 << levels.most);
    EXPECT_LE(refused, levels.most);
    levels = walk.next(levels);
    EXPECT_EQ(levels.most, most);
    EXPECT_TRUE(is_valid(levels));
  }
  StepWalk walk(0, levels);
  walk.accept(StepVerdict::calm);
  walk.accept(StepVerdict::calm);
  EXPECT_EQ(walk.next(levels).most, 2);
}

TEST(StepLevels, BodiesThatAskForShortStepsGetThem) {
  StepWalk walk(3, {1, 2});
  EXPECT_EQ(walk.subdivisions(), 8);
  EXPECT_FALSE(walk.may_halve());
  for (int i = 0; i < 8; ++i) walk.accept(StepVerdict::calm);
  EXPECT_TRUE(walk.done());
  EXPECT_EQ(walk.next({1, 2}).first, 0);
}

TEST(StepLevels, TheRestOfASubstepIsDividedFurtherWhereABodyIsFaster) {
  StepWalk walk(1, {});
  walk.accept(StepVerdict::calm);
  walk.require(3);
  EXPECT_EQ(walk.subdivisions(), 8);
  EXPECT_EQ(walk.index(), 4);
  EXPECT_FALSE(walk.is_shortened());
  for (int i = 0; i < 4; ++i) walk.accept(StepVerdict::calm);
  EXPECT_TRUE(walk.done());
  EXPECT_EQ(walk.next({}), StepLevels{});
}

TEST(StepLevels, WherePointsFallBackBodiesAreGivenShorterStepsAllTheSame) {
  StepWalk walk(3, {1, 2});
  EXPECT_FALSE(walk.may_halve());
  for (const int subdivisions : {8, 16, 32, 64, 128}) {
    EXPECT_EQ(walk.subdivisions(), subdivisions);
    EXPECT_TRUE(walk.may_halve_fallen());
    walk.halve();
  }
  EXPECT_FALSE(walk.may_halve_fallen());
  walk.accept(StepVerdict::fallen);
  // It was no help: the rest of the substep is not tried again.
  while (!walk.done()) {
    EXPECT_FALSE(walk.may_halve_fallen() && walk.subdivisions() == 256);
    walk.accept(StepVerdict::calm);
  }
}

TEST(StepLevels, ASolveThatRanAwayIsHalvedEvenWhereHalvingDidNotHelpBefore) {
  StepWalk walk(0, {1, 2});
  walk.accept(StepVerdict::forced);
  EXPECT_FALSE(walk.may_halve());
  for (int level = 1; level < finest_level; ++level) {
    EXPECT_TRUE(walk.may_halve_wild());
    walk.halve();
  }
  EXPECT_FALSE(walk.may_halve_wild());
}

TEST(StepLevels, AreFewWhileSeamsAreSewn) {
  StepWalk walk(1, {});
  int halved = 0;
  for (; walk.may_halve_sewn(); ++halved) walk.halve();
  EXPECT_EQ(halved, 2) << "beyond those that bodies require";
  EXPECT_TRUE(walk.may_halve());
}

}  // namespace
}  // namespace weft
