#include "weft/sim/step_pieces.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

Planes3 all_at(Vec3f place) {
  Planes3 planes(2);
  for (int s = 0; s < 4; ++s) planes.set(s, place);
  return planes;
}

TEST(StepPieces, ArePowersOfTwoThatKeepWaysShort) {
  EXPECT_EQ(pieces_for(0, 1), 1);
  EXPECT_EQ(pieces_for(1, 1), 1);
  EXPECT_EQ(pieces_for(1.01, 1), 2);
  EXPECT_EQ(pieces_for(4.1, 1), 8);
  EXPECT_EQ(pieces_for(1e9, 1), most_pieces);
}

TEST(StepPieces, SweptBoxHoldsWhereClothIsAndWhereItFlies) {
  const Box3d box = swept_box({all_at({1, 2, 3}), all_at({4, 0, -2})}, 0.5, 0.25);
  EXPECT_EQ(box.lower, (Vec3d{0.75, 1.75, 1.75}));
  EXPECT_EQ(box.upper, (Vec3d{3.25, 2.25, 3.25}));
}

TEST(StepPieces, TheFarthestOfAllWaysIsFound) {
  const Planes3 from = all_at({1, 2, 3});
  Planes3 to = from;
  EXPECT_EQ(farthest_way(from, to), 0);
  to.set(1, {1, 5, -1});
  EXPECT_EQ(farthest_way(from, to), 5);
}

TEST(StepPieces, OnlyWaysNearClothCount) {
  const Box3d box{{0, 0, 0}, {1, 1, 1}};
  Planes3 from = all_at({9, 0, 0}), to = all_at({9, 9, 0});
  EXPECT_EQ(farthest_way(from, to, box), 0);
  from.set(1, {0.5F, -2, 0.5F});
  to.set(1, {0.5F, 3, 0.5F});  // through the box, though neither end is within
  EXPECT_EQ(farthest_way(from, to, box), 5);
}

}  // namespace
}  // namespace weft
