#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "weft/cloth/baselines/contact_terms.h"
#include "weft/cloth/kernels/kernel_table.h"
#include "weft/core/thread_team.h"

namespace weft {

/// Contact terms of a level's operator: a symmetric 3 x 3 block for every sample, on the finest
/// level the sum of k n n^T + grip (1 - n n^T) over its contacts, see ContactGather::add_blocks, on
/// coarser ones the restriction of these. Runs of columns without contact keep the scalar operator,
/// which reads one plane where blocks are six.
class ContactBlocks {
 public:
  ContactBlocks() = default;
  explicit ContactBlocks(int size);

  /// Whether a row has contacts.
  [[nodiscard]] bool row(int r) const { return rows_[static_cast<std::size_t>(r)] != 0; }

  // To be called row by row, by any team, in this order and with barriers between.
  void set_row(const ContactLoads& contacts, int row);
  void restrict_row(const ContactBlocks& fine, int row, float* line);
  /// Computes (D + C)^-1 of the row's samples; for samples with mates it is wrong until join_mates.
  /// @param inverse_diagonal  [n] D^-1, 0 where held
  void invert_row(int row, const float* inverse_diagonal);
  void join_mates(const BorderMates& mates, const Grid<float>& inverse_diagonal, Range classes);

  /// C of a row's samples from a column on, and (D + C)^-1; the latter where they are touched.
  [[nodiscard]] BlockRow own_row(int row, int col = 0) const { return block_row(own_, row, col); }
  [[nodiscard]] BlockRow inverse_row(int row, int col) const {
    return block_row(inverse_, row, col);
  }
  /// Calls visit(columns, touched) for a row's columns, left to right: runs that contacts touch and
  /// runs that none does in turn.
  template <class Visit>
  void for_runs(int row, const Visit& visit) const {
    for (int run = 0; run < runs_;) {
      const int first = run;
      const bool is_touched = touched(row, first);
      while (run < runs_ && touched(row, run) == is_touched) ++run;
      visit(Range{first * run_length, std::min(size_, run * run_length)}, is_touched);
    }
  }
  /// Own part of a sample's block: xx, xy, xz, yy, yz, zz [N/m].
  [[nodiscard]] std::array<float, 6> block(int sample) const;

 private:
  using Planes = std::array<Grid<float>, 6>;
  void clear_row(int row);
  static constexpr int run_length = 16;
  static BlockRow block_row(const Planes& planes, int row, int col) {
    return {planes[0].row(row) + col, planes[1].row(row) + col, planes[2].row(row) + col,
            planes[3].row(row) + col, planes[4].row(row) + col, planes[5].row(row) + col};
  }
  [[nodiscard]] bool touched(int row, int run) const {
    return touched_[static_cast<std::size_t>(row) * runs_ + run] != 0;
  }
  /// Marks the runs of a row that have contacts.
  void touch_row(int row);

  int size_ = 0, runs_ = 0;
  std::vector<char> rows_, touched_;  // touched: [rows x runs]
  Planes own_, inverse_;
};

}  // namespace weft
