#include "weft/sim/shadow.h"

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "weft/image/builtin.h"

namespace weft {
namespace {

using testing::flat_sheet;

TEST(Shadow, OfALevelSheetIsItsArea) { EXPECT_NEAR(shadow_area(flat_sheet(9)), 1, 2e-3); }

TEST(Shadow, OfATiltedSheetIsItsProjection) {
  Planes3 p = flat_sheet(9);
  for (int s = 0; s < 81; ++s) {
    const Vec3f at = p.at(s);
    p.set(s, {0.6F * at.x, 0.8F * at.x, at.z});
  }
  EXPECT_NEAR(shadow_area(p), 0.6, 2e-3);
}

TEST(Shadow, CountsWhatLiesOverItselfOnce) {
  // Folded along its middle column.
  Planes3 p = flat_sheet(9);
  for (int s = 0; s < 81; ++s) {
    const Vec3f at = p.at(s);
    p.set(s, {std::abs(at.x), at.x > 0 ? 0.01F : 0.0F, at.z});
  }
  EXPECT_NEAR(shadow_area(p), 0.5, 2e-3);
}

TEST(Shadow, OfADiskIsThatOfItsPolygon) {
  const int n = 65, corners = 4 * (n - 1);
  const double polygon = 0.5 * corners * 0.25 * sine(2 * pi / corners);
  EXPECT_NEAR(shadow_area(world_positions(make_image_shape("disk", n))), polygon, 2e-4);
}

TEST(Shadow, OfAPointIsNone) { EXPECT_EQ(shadow_area(Planes3(5)), 0); }

}  // namespace
}  // namespace weft
