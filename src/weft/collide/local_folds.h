#pragma once

#include <vector>

#include "weft/collide/cell_pairs.h"
#include "weft/collide/extent_levels.h"

namespace weft {

/// Judges pairs of cells that lie near each other in the image: what holds them always meets, the
/// more of them the farther they move in a step, and what counts is whether the surface can fold
/// between them.
class LocalFolds {
 public:
  explicit LocalFolds(int cells) : row_edges_(cells), column_edges_(cells) {}
  /// Takes a step's motion. To be called by every worker; ends with a barrier.
  void fit(const MovingSurface& surface, Worker& worker);
  /// True when a rectangle of the image around the two cells certainly stays unfolded while every
  /// sample keeps within `slack` of its path. Looked at are the nodes of the least level on which
  /// the two are within two nodes of each other, so that it costs the same for all pairs.
  [[nodiscard]] bool unfolded(const CellPair& pair, float slack) const;

 private:
  ExtentLevels row_edges_, column_edges_;
};

/// Gives what every worker found in the order of the workers, which is that of the work.
class SharedPairs {
 public:
  /// Calls find(i, mine) for i in 0 .. count - 1, which adds to `mine`, and adds all to `out`.
  template <class Find>
  void collect(int count, ThreadTeam& team, std::vector<CellPair>& out, const Find& find) {
    found_.resize(static_cast<std::size_t>(team.size()));
    for (std::vector<CellPair>& mine : found_) mine.clear();
    team.run([&](Worker& worker) {
      std::vector<CellPair>& mine = found_[static_cast<std::size_t>(worker.rank())];
      const Range share = worker.share(count);
      for (int i = share.first; i < share.last; ++i) find(i, mine);
    });
    for (const std::vector<CellPair>& mine : found_)
      out.insert(out.end(), mine.begin(), mine.end());
  }

 private:
  std::vector<std::vector<CellPair>> found_;  // one a worker
};

}  // namespace weft
