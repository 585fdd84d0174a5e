#include "weft/grid.h"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "weft/core/hash.h"

namespace weft {
namespace {

TEST(Grid, RowsStartOnCacheLines) {
  for (const int cols : {1, 5, 16, 17, 257}) {
    Grid<float> grid(3, cols);
    EXPECT_GE(grid.stride(), cols);
    for (int r = 0; r < 3; ++r) EXPECT_EQ(reinterpret_cast<std::uintptr_t>(grid.row(r)) % 64, 0U);
  }
}

TEST(Grid, CopiesAreIndependentAndEqual) {
  Grid<int> a(3, 5, 7);
  Grid<int> b = a;
  b(2, 4) = 8;
  EXPECT_EQ(a(2, 4), 7);
  a = b;
  EXPECT_EQ(a(2, 4), 8);
  EXPECT_EQ(a(0, 0), 7);
}

TEST(Hash, OfAGridLeavesPaddingOut) {
  Grid<float> grid(2, 3, 1.5F);
  Hash padded;
  padded.add(grid);
  grid.row(0)[3] = 99;
  Hash changed_padding;
  changed_padding.add(grid);
  EXPECT_EQ(padded.value(), changed_padding.value());
  grid(1, 2) = 1.25F;
  Hash changed;
  changed.add(grid);
  EXPECT_NE(padded.value(), changed.value());
}

TEST(Hash, KnowsThePublishedValues) {
  Hash hash;
  EXPECT_EQ(hash.text(), "cbf29ce484222325");
  const std::vector<char> letters{'f', 'o', 'o', 'b', 'a', 'r'};
  hash.add(std::span<const char>(letters));
  EXPECT_EQ(hash.text(), "85944171f73967e8");
}

TEST(Planes3, SampleIndexIsRowTimesSizePlusColumn) {
  Planes3 planes(5);
  planes.set(2, 3, {1, 2, 3});
  EXPECT_EQ(planes.at(2 * 5 + 3), (Vec3f{1, 2, 3}));
}

}  // namespace
}  // namespace weft
