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

/// Gathers the loads of contacts at the samples of one cloth, in a fixed order: a sample gets its
/// weight times the contact's load. A class of mates is one particle: the load on one of its
/// samples is shared evenly among all.
class ContactGather {
 public:
  /// @param cloth  kept by reference
  explicit ContactGather(const Cloth& cloth);

  // Call clear, add any number of times and finish before the rest.
  void clear();
  /// @param contact  its index
  void add(int sample, int contact, float weight);
  void finish();

  /// Contacts as springs in the matrix of a step, by index.
  struct Springs {
    std::span<const Contact> contacts;
    std::span<const float> stiffness;  ///< along the normal, 0: inactive [N/m] or the like
    std::span<const float> grip;       ///< along the surface, the same
  };
  /// Marks those of a worker's rows that have active contacts; no barrier.
  void mark_rows(std::span<const float> stiffness, const Worker& worker);
  /// Whether a row has active contacts.
  [[nodiscard]] bool row(int r) const { return rows_[static_cast<std::size_t>(r)] != 0; }
  /// Whether any row has active contacts; after all workers marked theirs.
  [[nodiscard]] bool any() const;

  /// Adds each sample's own part of loads to a row.
  void add_row(int row, std::span<const Vec3f> loads, Row3 out) const;
  /// Adds to a row each sample's own part of 3 x 3 blocks (xx, xy, xz, yy, yz, zz) that together
  /// bound the springs' matrix from above: w w^T is at most sum |w| times the diagonal of |w|, so a
  /// sample gets sum |w| |w_i| times stiffness * n n^T + grip * (1 - n n^T).
  void add_blocks(int row, const Springs& springs, const std::array<float*, 6>& block) const;

 private:
  const Cloth& cloth_;
  std::vector<int> class_at_;  // [n n] class of each sample, -1 where it has no mates
  ContactUses uses_;
  std::vector<int> row_starts_;  // [n + 1] into uses_.samples()
  std::vector<char> rows_;
};

}  // namespace weft
