#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/cloth/cloth.h"
#include "weft/cloth/kernels/row_pointers.h"
#include "weft/contact.h"
#include "weft/core/contact_uses.h"
#include "weft/core/thread_team.h"

namespace weft {

/// Gathers what contacts do to the samples of one cloth, in a fixed order: of each contact's load a
/// sample gets its weight's part. A class of mates is one particle: what a contact does to one of
/// its samples is shared out among all.
class ContactGather {
 public:
  /// @param cloth  kept by reference
  explicit ContactGather(const Cloth& cloth);

  // clear, add any number of times, finish; then the rest.
  void clear();
  /// @param contact  its number
  void add(int sample, int contact, float weight);
  void finish();

  /// What contacts are to the matrix of a step, by number.
  struct Springs {
    std::span<const Contact> contacts;
    std::span<const float> stiffness;  ///< along the normal, 0: it does nothing [N/m] or the like
    std::span<const float> grip;       ///< along the surface, the same
  };
  /// Finds out which of a worker's rows have stiff contacts; no barrier.
  void mark_rows(std::span<const float> stiffness, const Worker& worker);
  /// Whether a row has.
  [[nodiscard]] bool row(int r) const { return rows_[static_cast<std::size_t>(r)] != 0; }
  /// Whether any row has; after all workers marked theirs.
  [[nodiscard]] bool any() const;

  /// Adds each sample's own part of loads to a row.
  void add_row(int row, std::span<const Vec3f> loads, Row3 out) const;
  /// Adds to a row each sample's own part of 3 x 3 blocks (xx, xy, xz, yy, yz, zz) that together
  /// bound the springs' matrix from above: w w^T is at most sum |w| times the diagonal of |w|, so a
  /// sample gets sum |w| |w_i| times stiffness * n n^T + grip * (1 - n n^T).
  void add_blocks(int row, const Springs& springs, const std::array<float*, 6>& block) const;

 private:
  const Cloth& cloth_;
  std::vector<int> class_at_;  // of border positions, -1 where a sample is alone
  ContactUses uses_;
  std::vector<int> row_starts_;  // [n + 1] into uses_.samples()
  std::vector<char> rows_;
};

}  // namespace weft
