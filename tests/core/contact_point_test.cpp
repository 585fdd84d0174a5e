#include "weft/core/contact_point.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

TEST(PointCompliance, IsThatOfThePointBetweenItsSamples) {
  PointCompliance compliance;
  compliance.add(0.25, 2);
  compliance.add(-0.75, 4);
  EXPECT_DOUBLE_EQ(compliance.value(), 0.0625 * 2 + 0.5625 * 4);
}

TEST(PointCompliance, IsZeroOnPinnedSamplesAlone) {
  PointCompliance compliance;
  compliance.add(0.5, 0);
  compliance.add(0.5, 0);
  EXPECT_EQ(compliance.value(), 0);
}

/// Taken as it is, a stiffness by it would fling the free sample: by 17 m for 1 mm.
TEST(PointCompliance, IsNotTinyNearlyOnAPinnedSample) {
  PointCompliance compliance;
  compliance.add(0.9999, 0);
  compliance.add(0.0001, 3);
  EXPECT_GT(compliance.value(), 0.03 * 3);
}

}  // namespace
}  // namespace weft
