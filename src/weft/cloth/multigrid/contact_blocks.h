#pragma once

#include <array>
#include <vector>

#include "weft/cloth/integrate/contact_loads.h"
#include "weft/cloth/kernels/kernel_table.h"
#include "weft/core/thread_team.h"

namespace weft {

/// What contacts add to a level's operator: a symmetric 3 x 3 block for every sample, a sum
/// of k n n^T on the finest level, on coarser ones what restriction gathers of it. They hold along
/// normals and leave sliding free. Rows without contact stay with the scalar operator.
class ContactBlocks {
 public:
  ContactBlocks() = default;
  explicit ContactBlocks(int size);

  /// Whether a row has contacts.
  [[nodiscard]] bool row(int r) const { return rows_[static_cast<std::size_t>(r)] != 0; }

  // Renewing goes row by row, by any team: each of these in turn, with barriers between.
  void take_row(const ContactLoads& contacts, int row);
  void restrict_row(const ContactBlocks& fine, int row, float* line);
  /// (D + C)^-1 of the row's samples, which for samples with mates is wrong until join_mates.
  /// @param inverse_diagonal  [n] D^-1, 0 where held
  void invert_row(int row, const float* inverse_diagonal);
  void join_mates(const BorderMates& mates, const Grid<float>& inverse_diagonal, Range classes);

  /// C of a row's samples, and (D + C)^-1.
  [[nodiscard]] BlockRow own_row(int row) const { return block_row(own_, row); }
  [[nodiscard]] BlockRow inverse_row(int row) const { return block_row(inverse_, row); }
  /// Own part of a sample's block: xx, xy, xz, yy, yz, zz [N/m].
  [[nodiscard]] std::array<float, 6> block(int sample) const;

 private:
  using Planes = std::array<Grid<float>, 6>;
  void clear_row(int row);
  static BlockRow block_row(const Planes& planes, int row) {
    return {planes[0].row(row), planes[1].row(row), planes[2].row(row),
            planes[3].row(row), planes[4].row(row), planes[5].row(row)};
  }

  int size_ = 0;
  std::vector<char> rows_;
  Planes own_, inverse_;
};

}  // namespace weft
