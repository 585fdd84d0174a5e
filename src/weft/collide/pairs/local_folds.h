#pragma once

#include "weft/collide/pairs/cell_pairs.h"
#include "weft/collide/pairs/extent_levels.h"

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

}  // namespace weft
