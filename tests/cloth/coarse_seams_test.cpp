#include "weft/cloth/newton/coarse_seams.h"

#include <set>

#include <gtest/gtest.h>

#include "weft/cloth/newton/short_ends.h"

namespace weft {
namespace {

/// A square whose first side is sewn to its last, so many samples farther from their corner.
BorderMates sewn(int size, int count, int shift) {
  return {size, {{1 + shift, 4 * (size - 1) - 1, count}}};
}

struct Levels {
  LevelLayout finest, level;
  CoarseSeams seams;
};

Levels coarse(const BorderMates& mates, int depth) {
  Levels made{LevelLayout(mates), LevelLayout(mates), {}};
  for (int i = 0; i < depth; ++i) made.level = made.level.coarsened();
  made.seams = find_coarse_seams(mates, made.finest, made.level, depth);
  return made;
}

/// Where a node lies on the border of a square of one chart, in samples from its first corner.
int along_border(int node, int nodes, int depth, int size) {
  const int row = node / nodes, col = node % nodes;
  const auto place = [&](int k) { return k == nodes - 1 ? size - 1 : k << depth; };
  if (row == 0) return place(col);
  if (col == nodes - 1) return size - 1 + place(row);
  if (row == nodes - 1) return 3 * (size - 1) - place(col);
  return 4 * (size - 1) - place(row);
}

TEST(CoarseSeams, EveryNodeIsOfOneClassOrHangsFromNodesThatDoNot) {
  for (const int size : {17, 18, 33, 34})
    for (const int shift : {0, 1, 2, 3})
      for (const int depth : {1, 2, 3}) {
        const Levels made = coarse(sewn(size, size - 8, shift), depth);
        std::set<int> seen;
        for (const std::vector<int>& one : made.seams.classes) {
          EXPECT_GT(one.size(), 1U);
          for (const int node : one) EXPECT_TRUE(seen.insert(node).second);
        }
        std::set<int> hanging;
        for (const HangingNode& one : made.seams.hanging) {
          EXPECT_TRUE(seen.insert(one.node).second);
          hanging.insert(one.node);
        }
        for (const HangingNode& one : made.seams.hanging) {
          float sum = 0;
          for (const HangingNode::Part& part : one.parts) {
            sum += part.weight;
            EXPECT_EQ(hanging.count(part.node), 0U);
          }
          EXPECT_NEAR(sum, 1, 1e-6);
        }
      }
}

// A field that is linear along the seam is the same at both of its sides.
TEST(CoarseSeams, WhatIsLinearAlongASeamIsTheSameOnBothSides) {
  for (const int size : {33, 34})
    for (const int shift : {1, 2, 3}) {
      const int depth = 2, start = 1 + shift, count = 24;
      const Levels made = coarse(sewn(size, count, shift), depth);
      ASSERT_FALSE(made.seams.hanging.empty());
      // The side that starts first gets its place; the other one runs backwards from its start.
      const int other = 4 * (size - 1) - 1;
      int seen = 0;
      for (const HangingNode& one : made.seams.hanging) {
        const int place = other - along_border(one.node, made.level.size, depth, size) + start;
        double value = 0;
        for (const HangingNode::Part& part : one.parts)
          value += part.weight * along_border(part.node, made.level.size, depth, size);
        if (place > start + 4 && place < start + count - 4) {
          EXPECT_NEAR(value, place, 1e-5) << size << ' ' << shift;
          ++seen;
        }
      }
      EXPECT_GT(seen, 2);
    }
}

TEST(ShortEnds, TheLastNodeLiesAtTheLastSample) {
  const BorderMates mates(10, {{1, 4 * 9 - 1, 8}});
  const LevelLayout fine(mates), level = fine.coarsened();
  const ShortEnds ends(fine, level);
  ASSERT_FALSE(ends.empty());
  Worker worker = Worker::lone();
  const Workers alone(worker, true);
  PaddedVectors values(level.size, level.size), restricted(level.size, level.size);
  for (int r = 0; r < level.size; ++r)
    for (int c = 0; c < level.size; ++c) {
      values.x(r, c) = static_cast<float>(3 * r + c * c);
      restricted.x(r, c) = static_cast<float>(r * c + 1);
    }
  const int last = level.size - 1;
  const float corner = values.x(last, last);
  double before = 0, after = 0;
  PaddedVectors folded(level.size, level.size);
  for (int r = 0; r <= last; ++r)
    for (int c = 0; c <= last; ++c) folded.x(r, c) = restricted.x(r, c);
  ends.fold(alone, folded);
  for (int r = 0; r <= last; ++r)
    for (int c = 0; c <= last; ++c) after += double{folded.x(r, c)} * double{values.x(r, c)};
  ends.extrapolate(alone, values);
  for (int r = 0; r <= last; ++r)
    for (int c = 0; c <= last; ++c) before += double{restricted.x(r, c)} * double{values.x(r, c)};
  // The mean that the last sample is given is the node's own value; both ways are transposes.
  EXPECT_FLOAT_EQ(0.25F * (values.x(last, last) + values.x(last - 1, last) +
                           values.x(last, last - 1) + values.x(last - 1, last - 1)),
                  corner);
  EXPECT_NEAR(before, after, 1e-3);
}

}  // namespace
}  // namespace weft
