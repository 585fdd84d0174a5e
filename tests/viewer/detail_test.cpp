#include "apps/viewer/detail.h"

#include <gtest/gtest.h>

namespace weft::viewer {
namespace {

TEST(Detail, QuickPicturesAreAlwaysFine) {
  Detail detail;
  for (int i = 0; i < 100; ++i) {
    detail.begin(true, 0.02 * i);
    EXPECT_EQ(detail.pixel(), 1);
    EXPECT_FALSE(detail.keeps_light());
    detail.end(0.008);
  }
}

TEST(Detail, SlowPicturesAreCoarseWhileThingsMoveAndFineAfterwards) {
  Detail detail;
  detail.begin(true, 0);
  detail.end(0.4);
  int kept = 0;
  for (int i = 1; i <= 16; ++i) {
    detail.begin(true, 0.1 * i);
    EXPECT_GT(detail.pixel(), 1);
    kept += detail.keeps_light() ? 1 : 0;
    detail.end(0.08);
    EXPECT_FALSE(detail.wants_finer(0.1 * i + 0.1));
  }
  EXPECT_EQ(kept, 14);
  EXPECT_TRUE(detail.wants_finer(2.0));
  detail.begin(false, 2.0);
  EXPECT_EQ(detail.pixel(), 1);
  EXPECT_FALSE(detail.keeps_light());
  EXPECT_FALSE(detail.wants_finer(3.0));
}

TEST(Detail, PicturesThatBecomeQuickBecomeFine) {
  Detail detail;
  detail.begin(true, 0);
  detail.end(0.4);
  detail.begin(true, 0.1);
  EXPECT_GT(detail.pixel(), 1);
  detail.end(0.0005);
  detail.begin(true, 0.2);
  EXPECT_EQ(detail.pixel(), 1);
}

TEST(Detail, APictureForAFileIsFine) {
  Detail detail;
  detail.begin(true, 0);
  detail.end(0.4);
  detail.ask_for_fine();
  detail.begin(true, 0.1);
  EXPECT_EQ(detail.pixel(), 1);
  EXPECT_FALSE(detail.keeps_light());
}

}  // namespace
}  // namespace weft::viewer
