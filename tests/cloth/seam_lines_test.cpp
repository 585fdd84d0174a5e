#include "weft/cloth/newton/seam_lines.h"

#include <gtest/gtest.h>

#include "tests/cloth/cut_sheet.h"
#include "tests/cloth/newton_system.h"

namespace weft {
namespace {

using testing::CutSheet;
using testing::System;

using Block = std::array<double, block_entries>;

Block block_at(const PlaneSet& blocks, int n, int sample) {
  Block block;
  for (int k = 0; k < block_entries; ++k) block[k] = blocks(sample / n, sample % n, k);
  return block;
}

/// Adds t 1 + s s^T.
void add_spring(const PlaneSet& near, const BorderEdge& edge, Block& sum) {
  const auto entry = [&](int k) {
    return double{near(edge.row, edge.col, (edge.along_row ? 0 : spring_entries) + k)};
  };
  const double t = entry(0), x = entry(1), y = entry(2), z = entry(3);
  const Block spring{t + x * x, x * y, x * z, t + y * y, y * z, t + z * z};
  for (int k = 0; k < block_entries; ++k) sum[k] += spring[k];
}

/// The diagonal block of a sample's row or column: what holds it beside that line's springs, and
/// those.
Block whole_block(const System& system, int sample, bool along_row) {
  const int n = system.cloth.size, row = sample / n, col = sample % n;
  const BlockLevel& finest = system.multigrid.finest();
  Block sum = block_at(along_row ? finest.held_rows : finest.held_cols, n, sample);
  for (const BorderEdge& edge :
       {BorderEdge{along_row, row, col},
        BorderEdge{along_row, along_row ? row : row - 1, along_row ? col - 1 : col}}) {
    std::vector<BorderEdge> copies{edge};
    for (const std::vector<BorderEdge>& group : system.multigrid.seams().edges())
      if (std::find(group.begin(), group.end(), edge) != group.end()) copies = group;
    for (const BorderEdge& copy : copies) add_spring(system.springs.near(), copy, sum);
  }
  return sum;
}

/// Of all particles, in both directions, how far the blocks of a cut sheet's lines are from those
/// of the uncut one, over their size.
double largest_difference(const std::vector<Chart>& parts, int n) {
  const CutSheet sheet(n, parts);
  const Cloth whole = make_cloth(testing::flat_sheet(n), testing::no_mates(n), testing::woven),
              cut = make_cloth(sheet.rest, sheet.mates, testing::woven);
  const Planes3 at = testing::shaken_rest(whole, 0.2 * whole.rest_spacing);
  const System of_whole(whole, at), of_cut(cut, sheet.cut(at));
  double worst = 0;
  for (int s = 0; s < n * n; ++s)
    for (const bool along_row : {true, false}) {
      const Block wanted = whole_block(of_whole, s, along_row),
                  found = whole_block(of_cut, sheet.sample_of(s), along_row);
      for (int k = 0; k < block_entries; ++k)
        worst =
            std::max(worst, std::abs(found[k] - wanted[k]) / (wanted[0] + wanted[3] + wanted[5]));
    }
  return worst;
}

TEST(SeamLines, HoldParticlesAsTheUncutSheetDoes) {
  EXPECT_LT(largest_difference(testing::quarters(17), 17), 1e-6);
  EXPECT_LT(largest_difference(testing::pinwheel(17), 17), 1e-6);
}

TEST(SeamLines, FixOtherCopies) {
  const CutSheet sheet(17, testing::quarters(17));
  const Cloth cut = make_cloth(sheet.rest, sheet.mates, testing::woven);
  const System system(cut);
  const BlockLevel& finest = system.multigrid.finest();
  const Seams& seams = system.multigrid.seams();
  for (int i = 0; i < seams.class_count(); ++i)
    for (const int s : seams.samples(i)) {
      const bool fixed = block_at(finest.held_rows, cut.size, s)[0] == holding_stiffness;
      EXPECT_EQ(fixed, s != seams.samples(i).front()) << s;
    }
}

}  // namespace
}  // namespace weft
