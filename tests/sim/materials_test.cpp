#include <fmt/format.h>
#include <gtest/gtest.h>

#include "weft/fabric.h"
#include "weft/files.h"

namespace weft {
namespace {

/// As the document writes it.
std::string pair_text(WarpWeft pair) {
  const std::string warp = fmt::format("{}", pair.warp);
  return pair.warp == pair.weft ? warp : fmt::format("{} / {}", warp, pair.weft);
}

TEST(Materials, DocumentListsTheirValues) {
  const std::string text = read_file(std::string(WEFT_SOURCE_DIR) + "/docs/materials.md");
  ASSERT_FALSE(named_materials().empty());
  for (const auto& [name, m] : named_materials()) {
    const std::string start =
        fmt::format("| {} | {} | {} |", name, m.density, pair_text(m.bending));
    EXPECT_NE(text.find(start), std::string::npos) << start;
    const std::string rest =
        fmt::format("| {} | {} | {} | {} |", pair_text(m.stretch), m.shear, m.damping, m.thickness);
    EXPECT_NE(text.find(rest), std::string::npos) << name << ": " << rest;
  }
}

TEST(Materials, BendingLengthsAreThoseOfFabrics) {
  // Cantilever tests of clothing find 1 to 4 cm.
  for (const auto& [name, m] : named_materials())
    for (const double bending : {m.bending.warp, m.bending.weft}) {
      const double cubed = bending / (m.density * 9.81);
      EXPECT_GT(cubed, 0.01 * 0.01 * 0.01) << name;
      EXPECT_LT(cubed, 0.04 * 0.04 * 0.04) << name;
    }
}

TEST(Materials, HaveTheirTrueStiffnessAndNoLimiter) {
  for (const auto& [name, m] : named_materials()) {
    EXPECT_EQ(m.strain_limit, 0) << name;
    EXPECT_GE(m.stretch.warp, m.stretch.weft) << name;
    const bool knit = name == "jersey";
    EXPECT_GE(m.stretch.warp, knit ? 500 : 1e4) << name;
    EXPECT_LE(m.stretch.warp, knit ? 5000 : 5e4) << name;
    // Threads turn where they cross; leather has none.
    EXPECT_GE(m.shear, 10) << name;
    EXPECT_LE(m.shear, name == "leather" ? 2000 : 300) << name;
  }
}

}  // namespace
}  // namespace weft
