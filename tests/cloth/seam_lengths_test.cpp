#include "weft/cloth/seam_lengths.h"

#include <gtest/gtest.h>

#include "weft/cloth/cloth.h"

namespace weft {
namespace {

/// Two charts of 5 x 5 samples, one above the other, sewn along the long sides that they show each
/// other: the upper is 2 m wide, the lower 4 m.
class SeamLengthsOfTwo : public ::testing::Test {
 protected:
  static constexpr int n = 11;
  SeamLengthsOfTwo() {
    const std::vector<Chart> charts{{"upper", 0, 0, 5, 5}, {"lower", 6, 0, 5, 5}};
    mates_ = BorderMates(n, charts, {{8, 20, 4}});
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c)
        rest_.set(at(r, c),
                  {(r < 6 ? 0.5F : 1.0F) * static_cast<float>(c), -static_cast<float>(r), 0});
  }
  static int at(int row, int col) { return row * n + col; }
  BorderMates mates_;
  Planes3 rest_{n};
};

TEST_F(SeamLengthsOfTwo, AreThoseOfTheShorterEdge) {
  ASSERT_EQ(mates_.representative(at(6, 0)), at(4, 0));
  ASSERT_EQ(mates_.representative(at(6, 1)), at(4, 1));
  const SeamLengths seams(rest_, mates_, 1);
  EXPECT_EQ(seams.shortest(at(6, 0), at(6, 1), 1), 0.5F);
  EXPECT_EQ(seams.shortest(at(6, 2), at(6, 1), 1), 0.5F);
  EXPECT_EQ(seams.shortest(at(4, 0), at(4, 1), 0.5F), 0.5F);
  EXPECT_EQ(SeamLengths(rest_, mates_, 2).shortest(at(6, 0), at(6, 2), 2), 1);
}

TEST_F(SeamLengthsOfTwo, LeaveWhatIsNotOnTheSeam) {
  const SeamLengths seams(rest_, mates_, 1);
  EXPECT_EQ(seams.shortest(at(7, 0), at(7, 1), 1), 1);
  EXPECT_EQ(seams.shortest(at(6, 0), at(7, 0), 1), 1) << "away from it";
  EXPECT_EQ(seams.shortest(at(10, 0), at(10, 1), 1), 1) << "the other border";
}

TEST_F(SeamLengthsOfTwo, NothingIsGatheredToAPoint) {
  for (int c = 0; c < 5; ++c) rest_.set(at(4, c), {0, -4, 0});
  EXPECT_EQ(SeamLengths(rest_, mates_, 1).shortest(at(6, 0), at(6, 1), 1), 0.25F);
}

TEST_F(SeamLengthsOfTwo, ClothsTakeThem) {
  const Cloth cloth = make_cloth({rest_, mates_, nullptr, nullptr}, {});
  EXPECT_EQ(cloth.springs[stretch_u].rest_length(6, 0), 0.5F);
  EXPECT_EQ(cloth.springs[stretch_u].rest_length(7, 0), 1);
  EXPECT_EQ(cloth.springs[stretch_u].rest_length(4, 0), 0.5F);
}

}  // namespace
}  // namespace weft
