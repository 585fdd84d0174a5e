#pragma once

#include <vector>

#include "weft/cloth/newton/level_layout.h"
#include "weft/geometry_image.h"

namespace weft {

/// A node of a coarse level whose value is that of a point between nodes, as hanging nodes of
/// finite elements have: the first copy of its particle lies between two nodes of its chart.
struct HangingNode {
  struct Part {
    int node = 0;
    float weight = 0;
  };
  int node = 0;
  std::vector<Part> parts;  ///< of nodes that do not hang; the weights' sum is 1. None: it stays 0
};

/// The seams of a coarse level: what is interpolated from it is the same for all copies of a
/// particle wherever it is linear along seams, so that turning cloth tears none.
struct CoarseSeams {
  std::vector<std::vector<int>>
      classes;                       ///< nodes that are one particle, by their first; ascending
  std::vector<HangingNode> hanging;  ///< by node
};

/// The seams of the level that `depth` coarsenings of the finest one give.
/// @param mates  of the finest level  @param finest, level  layouts of both
CoarseSeams find_coarse_seams(const BorderMates& mates, const LevelLayout& finest,
                              const LevelLayout& level, int depth);

}  // namespace weft
