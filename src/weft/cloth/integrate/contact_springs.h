#pragma once

#include <span>
#include <vector>

#include "weft/cloth/cloth.h"
#include "weft/cloth/kernels/row_pointers.h"
#include "weft/core/contact.h"

namespace weft {

/// Contacts as one-sided springs along their normals: a particle beyond its half-space is pushed
/// back by k times its depth, k several times what the cloth holds it by, so that it comes to rest
/// within a small part of a micrometre, while a particle that leaves is not held. Of several
/// contacts a particle heeds the one that its proposal violates most; friction is the collider's.
class ContactSprings {
 public:
  explicit ContactSprings(int size);

  void clear();
  /// @param proposed          [n x n] positions [m]
  /// @param inverse_diagonal  [n x n] of the filter, 0 where held [m/N]
  void choose(const Cloth& cloth, std::span<const Contact> contacts, const Planes3& proposed,
              const Grid<float>& inverse_diagonal);
  [[nodiscard]] bool empty() const { return active_ == 0; }

  /// Whether a row has contacts.
  [[nodiscard]] bool row(int r) const { return rows_[static_cast<std::size_t>(r)] != 0; }
  /// [n x n] 0 where there is none, whole particles [N/m]
  [[nodiscard]] const Grid<float>& stiffness() const { return stiffness_; }
  [[nodiscard]] ConstRow3 normal_row(int row) const;

  /// force += share of k depth normal. @param share  [n] of mates; null: 1
  void add_force(int row, const float* share, const Planes3& position, Row3 force) const;

 private:
  Planes3 normal_;
  Grid<float> offset_;     // [m]
  Grid<float> stiffness_;  // [N/m]
  Grid<float> depth_;      // of the proposal [m]
  std::vector<char> rows_;
  int active_ = 0;
};

}  // namespace weft
