#pragma once

#include <cstdint>
#include <vector>

#include "weft/collide/broad_phase/candidate_pairs.h"
#include "weft/core/thread_team.h"

namespace weft {

/// Lists filled by several threads. The work is cut into a fixed number of chunks, so that the
/// order of what is found does not depend on the team, and chunks go to workers in turn, so that a
/// few hard ones do not all fall to one.
template <class List>
class ChunkedLists {
 public:
  /// To be called by every worker: visit(i, list) for its part of 0 .. count - 1.
  template <class Visit>
  void fill(int count, const Worker& worker, const Visit& visit) {
    for (int chunk = worker.rank(); chunk < chunks; chunk += worker.size()) {
      List& list = lists_[static_cast<std::size_t>(chunk)];
      list.clear();
      for (int i = first(count, chunk); i < first(count, chunk + 1); ++i) visit(i, list);
    }
  }
  /// The same by a team. Where there is nothing to visit no worker is woken.
  template <class Visit>
  void fill(int count, ThreadTeam& team, const Visit& visit) {
    team.run_if(count > 1, [&](Worker& worker) { fill(count, worker, visit); });
  }
  /// The lists of all chunks in their order.
  [[nodiscard]] const std::vector<List>& lists() const { return lists_; }

 private:
  static constexpr int chunks = 64;
  static int first(int count, int chunk) {
    return static_cast<int>(std::int64_t{count} * chunk / chunks);
  }

  std::vector<List> lists_{chunks};
};

/// Appends the lists of all chunks to one list.
template <class T>
void append(const ChunkedLists<std::vector<T>>& from, std::vector<T>& to) {
  for (const std::vector<T>& list : from.lists()) to.insert(to.end(), list.begin(), list.end());
}

}  // namespace weft
