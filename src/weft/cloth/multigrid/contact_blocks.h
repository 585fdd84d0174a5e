#pragma once

#include <array>
#include <vector>

#include "weft/cloth/integrate/contact_loads.h"
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

  /// out -= C x.
  void subtract_product(int row, ConstRow3 x, Row3 out) const;
  /// out = factor (D + C)^-1 in.
  void precondition(int row, float factor, ConstRow3 in, Row3 out) const;
  /// Own part of a sample's block: xx, xy, xz, yy, yz, zz [N/m].
  [[nodiscard]] std::array<float, 6> block(int sample) const;

 private:
  void clear_row(int row);

  int size_ = 0;
  std::vector<char> rows_;
  std::array<Grid<float>, 6> own_, inverse_;
};

}  // namespace weft
