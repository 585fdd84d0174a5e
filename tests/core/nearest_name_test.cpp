#include <gtest/gtest.h>

#include "weft/core/names.h"

namespace weft {
namespace {

TEST(NearestName, EditDistanceCountsLetters) {
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("abc", ""), 3);
  EXPECT_EQ(edit_distance("same", "same"), 0);
}

TEST(NearestName, FindsTheCandidateWithTheLeastEdits) {
  EXPECT_EQ(nearest_name("frmaes", {"substeps", "frames", "frame_rate"}), "frames");
  EXPECT_EQ(nearest_name("x", {"ab", "cd"}), "ab") << "the first of several";
  EXPECT_EQ(nearest_name("x", {}), "");
}

}  // namespace
}  // namespace weft
