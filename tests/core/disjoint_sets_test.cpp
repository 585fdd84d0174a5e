#include "weft/core/disjoint_sets.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

TEST(DisjointSets, TheRootIsTheLeastMember) {
  DisjointSets sets(6);
  EXPECT_TRUE(sets.join(5, 4));
  EXPECT_TRUE(sets.join(4, 2));
  EXPECT_TRUE(sets.join(3, 5));
  for (const int i : {2, 3, 4, 5}) EXPECT_EQ(sets.root(i), 2);
  EXPECT_EQ(sets.root(0), 0);
  EXPECT_EQ(sets.root(1), 1);
}

TEST(DisjointSets, ParitiesAddUpAlongTheWay) {
  DisjointSets sets(5);
  EXPECT_TRUE(sets.join(0, 1, 1));
  EXPECT_TRUE(sets.join(1, 2, 1));
  EXPECT_TRUE(sets.join(3, 4, 1));
  EXPECT_TRUE(sets.join(4, 2, 0));
  EXPECT_EQ(sets.parity(0), 0);
  EXPECT_EQ(sets.parity(1), 1);
  EXPECT_EQ(sets.parity(2), 0);
  EXPECT_EQ(sets.parity(4), 0);
  EXPECT_EQ(sets.parity(3), 1);
}

TEST(DisjointSets, ARingOfOddParityDoesNotAgree) {
  DisjointSets sets(3);
  EXPECT_TRUE(sets.join(0, 1, 1));
  EXPECT_TRUE(sets.join(1, 2, 1));
  EXPECT_FALSE(sets.join(2, 0, 1));
  EXPECT_TRUE(sets.join(2, 0, 0));
}

TEST(DisjointSets, ResetTakesThemApart) {
  DisjointSets sets(3);
  sets.join(0, 2, 1);
  sets.reset(3);
  EXPECT_EQ(sets.root(2), 2);
  EXPECT_EQ(sets.parity(2), 0);
}

}  // namespace
}  // namespace weft
