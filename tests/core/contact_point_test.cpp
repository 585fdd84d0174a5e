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

/// What a stiffness by the compliance moves the free sample by, for a depth of 1.
double way_of_free_sample(double weight) {
  PointCompliance compliance;
  compliance.add(1 - weight, 0);
  compliance.add(weight, 3);
  return 3 * weight / compliance.value();
}

/// A stiffness by the sum alone would fling the free sample: by 17 m for 1 mm.
TEST(PointCompliance, FadesContactsNearlyOnAPinnedSample) {
  EXPECT_DOUBLE_EQ(way_of_free_sample(0.5), 2);
  for (const double weight : {0.2, 0.1, 0.01, 1e-4}) EXPECT_LT(way_of_free_sample(weight), 6);
  EXPECT_LT(way_of_free_sample(1e-4), way_of_free_sample(0.01));
  EXPECT_LT(way_of_free_sample(1e-4), 1e-6);
}

}  // namespace
}  // namespace weft
