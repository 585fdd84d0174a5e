#include "weft/sim/materials.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "weft/core/files.h"

namespace weft {
namespace {

TEST(Materials, DocumentListsTheirValues) {
  const std::string text = read_file(std::string(WEFT_SOURCE_DIR) + "/docs/materials.md");
  ASSERT_FALSE(named_materials().empty());
  for (const auto& [name, m] : named_materials()) {
    const std::string start = fmt::format("| {} | {} | {} |", name, m.density, m.bending.warp);
    EXPECT_NE(text.find(start), std::string::npos) << start;
    const std::string rest = fmt::format("| {} | {} | {} | {} | {} |", m.stretch.warp, m.shear,
                                         m.damping, m.strain_limit, m.thickness);
    EXPECT_NE(text.find(rest), std::string::npos) << name << ": " << rest;
  }
}

TEST(Materials, BendingLengthsAreThoseOfFabrics) {
  // Cantilever tests of clothing find 1 to 4 cm.
  for (const auto& [name, m] : named_materials()) {
    const double cubed = m.bending.warp / (m.density * 9.81);
    EXPECT_GT(cubed, 0.01 * 0.01 * 0.01) << name;
    EXPECT_LT(cubed, 0.04 * 0.04 * 0.04) << name;
  }
}

}  // namespace
}  // namespace weft
