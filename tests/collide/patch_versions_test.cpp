#include "weft/collide/broad_phase/patch_versions.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

/// Of 13 x 13 cells: 4 x 4 patches.
constexpr int cells = 13, patches = 4;

TEST(PatchVersions, NodesHaveTheLatestOfTheirPatches) {
  PatchVersions versions(cells);
  EXPECT_EQ(versions.patches(), patches);
  EXPECT_EQ(versions.latest(), -1);
  versions.set(3, 1, 4);
  versions.set(0, 0, 5);
  EXPECT_EQ(versions.of(3 * patches + 1), 4);
  EXPECT_EQ(versions.of(Node{2, 3, 1}), 4);
  EXPECT_EQ(versions.of(Node{3, 1, 0}), 4);
  EXPECT_EQ(versions.of(Node{3, 0, 0}), 5);
  EXPECT_EQ(versions.of(Node{3, 1, 1}), -1);
  EXPECT_EQ(versions.latest(), 5);
}

TEST(PatchVersions, SquaresOfNodesGiveAllPatchesTheyShareCellsWith) {
  const auto given = [](const Node& first, int span) {
    PatchVersions versions(cells);
    versions.set_square(first, span, 1);
    unsigned found = 0;
    for (int patch = 0; patch < patches * patches; ++patch)
      if (versions.of(patch) == 1) found |= 1U << patch;
    return found;
  };
  EXPECT_EQ(given({1, 1, 2}, 2), 0x0022U) << "cells 2 to 5 of columns 4 to 7";
  EXPECT_EQ(given({1, 1, 1}, 3), 0x0033U) << "cells 2 to 7";
  EXPECT_EQ(given({0, 4, 4}, 2), 0x0020U);
  EXPECT_EQ(given({3, 0, 0}, 2), 0xFFFFU);
  EXPECT_EQ(given({2, 2, 2}, 3), 0xCC00U) << "beyond the last patch";
}

TEST(PatchVersions, TakeWhatHasAVersionElsewhere) {
  PatchVersions from(cells), to(cells);
  from.set(0, 0, 2);
  from.set(1, 2, 3);
  to.set(0, 0, 1);
  to.take(from, 3);
  EXPECT_EQ(to.of(0), 1);
  EXPECT_EQ(to.of(patches + 2), 3);
  EXPECT_EQ(to.latest(), 3);
}

}  // namespace
}  // namespace weft
