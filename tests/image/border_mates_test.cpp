#include <string>

#include <gtest/gtest.h>

#include "tests/support/errors.h"
#include "weft/error.h"
#include "weft/geometry_image.h"

namespace weft {
namespace {

std::string refusal(int size, std::vector<MateInterval> intervals) {
  return test::message_of<InputError>([&] { BorderMates(size, std::move(intervals)); });
}

std::vector<int> members(const BorderMates& mates, int index) {
  const std::span<const int> found = mates.mates(index);
  return {found.begin(), found.end()};
}

TEST(BorderMates, PositionsRunAlongRowZeroThenUpTheLastColumn) {
  const std::vector<int> samples{0, 1, 2, 5, 8, 7, 6, 3};
  for (int t = 0; t < 8; ++t) {
    EXPECT_EQ(border_sample(3, t), samples[t]);
    EXPECT_EQ(border_position(3, samples[t]), t);
  }
  EXPECT_EQ(border_position(3, 4), -1);
}

TEST(BorderMates, TorusHasOnePointAtItsFourCorners) {
  const BorderMates mates(5, {{0, 12, 4}, {4, 16, 4}});
  EXPECT_EQ(members(mates, 0), (std::vector<int>{0, 4, 20, 24}));
  EXPECT_EQ(mates.class_count(), 1 + 3 + 3);
  EXPECT_EQ(members(mates, 1), (std::vector<int>{1, 21}));
  EXPECT_EQ(members(mates, 4), (std::vector<int>{5, 9}));
  EXPECT_EQ(mates.representative(24), 0);
  EXPECT_EQ(mates.representative(9), 5);
  EXPECT_EQ(mates.representative(12), 12);
}

TEST(BorderMates, ThreePathsThatShareANodeMakeOneClassOfIt) {
  // Three curves from one node to three tips, each walked there and back.
  const BorderMates mates(7, {{0, 8, 4}, {8, 16, 4}, {16, 0, 4}});
  EXPECT_EQ(members(mates, 0), (std::vector<int>{0, border_sample(7, 8), border_sample(7, 16)}));
  for (const int tip : {4, 12, 20}) {
    const int sample = border_sample(7, tip);
    EXPECT_EQ(mates.representative(sample), sample);
    EXPECT_EQ(mates.representative(border_sample(7, tip - 1)),
              mates.representative(border_sample(7, tip + 1)));
  }
}

TEST(BorderMates, ClassesComeInOrderOfTheirLeastSample) {
  const BorderMates mates(9, {{20, 12, 6}, {0, 6, 3}});
  for (int k = 0; k + 1 < mates.class_count(); ++k)
    EXPECT_LT(mates.mates(k)[0], mates.mates(k + 1)[0]);
  for (int k = 0; k < mates.class_count(); ++k)
    for (std::size_t i = 1; i < mates.mates(k).size(); ++i)
      EXPECT_LT(mates.mates(k)[i - 1], mates.mates(k)[i]);
}

TEST(BorderMates, ImageWithoutMatesHasNoClass) {
  const BorderMates mates(5, {});
  EXPECT_EQ(mates.class_count(), 0);
  EXPECT_EQ(mates.representative(4), 4);
  EXPECT_EQ(BorderMates().class_count(), 0);
  EXPECT_EQ(BorderMates().representative(7), 7);
}

TEST(BorderMates, PositionsOutOfRangeAreNamed) {
  EXPECT_EQ(refusal(5, {{0, 17, 4}}),
            "mates 0 17 4; border positions in 0 .. 15 and a count in 1 .. 8");
  EXPECT_NE(refusal(5, {{-1, 12, 4}}), "");
  EXPECT_NE(refusal(5, {{0, 12, 0}}), "");
  EXPECT_NE(refusal(5, {{0, 12, 9}}), "");
  EXPECT_NE(refusal(1, {}), "");
  EXPECT_NE(refusal(1 << 20, {}), "");
}

TEST(BorderMates, AnEdgeHasOneMate) {
  EXPECT_EQ(refusal(5, {{0, 12, 4}, {3, 15, 2}}),
            "mates 3 15 2 that meet other mates at 3; runs of border samples that do not overlap "
            "are wanted");
  EXPECT_NE(refusal(5, {{0, 4, 4}}), "");
}

}  // namespace
}  // namespace weft
