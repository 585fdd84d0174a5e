#pragma once

#include <vector>

#include "weft/param/collapse_hierarchy.h"

namespace weft {

/// The inner vertices of a coarsened disk in groups, for a sweep by several threads: a vertex comes
/// in a later group than all its neighbours of lower index, so no two of a group are neighbours.
/// What moves the vertices of group after group, by what is around each, has the same bits as what
/// moves them in ascending order.
struct SweepSchedule {
  std::vector<int> vertices;  ///< group after group, ascending inside one
  std::vector<int> first{0};  ///< [groups + 1] where each begins
  int largest_valence = 0;

  [[nodiscard]] int group_count() const { return static_cast<int>(first.size()) - 1; }
};
SweepSchedule schedule_sweep(const CollapseHierarchy& mesh);

}  // namespace weft
