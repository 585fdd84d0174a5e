#pragma once

#include <span>

#include "weft/cloth/cloth.h"
#include "weft/core/contact.h"
#include "weft/core/thread_team.h"

namespace weft {

/// Contacts as constraints: a particle whose proposal is beyond its half-space is put onto its
/// surface and moves along it for the rest of the step, by filtering the normal part out of
/// residuals and directions [baraff98]. Unlike a stiff term on a diagonal that all coordinates
/// share, this leaves sliding free. Of several contacts a particle heeds the one that it violates
/// most; friction is the collider's.
class ContactFilter {
 public:
  explicit ContactFilter(int size);

  void clear();
  /// @param proposed  [n x n] positions [m]
  void choose(const Cloth& cloth, std::span<const Contact> contacts, const Planes3& proposed);
  /// Moves held particles onto their surfaces. To be called by every worker; ends with a barrier.
  void push_out(const Cloth& cloth, const Planes3& fall, Planes3& move, Worker& worker) const;
  /// Takes the normal part out of a row.
  void filter_row(Planes3& values, int row) const;

 private:
  Planes3 normal_;      // 0 where nothing holds
  Grid<float> offset_;  // [m]
  Grid<float> depth_;   // [m]
  int active_ = 0;
};

}  // namespace weft
