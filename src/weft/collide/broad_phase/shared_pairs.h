#pragma once

#include <vector>

#include "weft/collide/broad_phase/candidate_pairs.h"
#include "weft/collide/broad_phase/chunks.h"

namespace weft {

/// Collects pairs that a team finds, in an order that does not depend on the team.
class SharedPairs {
 public:
  /// Calls find(i, mine) for i in 0 .. count - 1, which adds to `mine`, and adds all to `out`.
  template <class Find>
  void collect(int count, ThreadTeam& team, std::vector<CandidatePair>& out, const Find& find) {
    team.run([&](Worker& worker) { found_.fill(count, worker, find); });
    append(found_, out);
  }

 private:
  ChunkedLists<std::vector<CandidatePair>> found_;
};

}  // namespace weft
