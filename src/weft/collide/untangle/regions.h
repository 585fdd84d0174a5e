#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/collide/moving_surface.h"
#include "weft/core/disjoint_sets.h"

namespace weft {

/// An edge by its samples, ascending, which stand for their classes.
using CutEdge = std::array<int, 2>;

/// The parts that a sheet falls into where edges are cut.
class Regions {
 public:
  /// @param cut  ascending; an edge that is there twice is whole
  void find(const SurfaceGrid& grid, std::span<const CutEdge> cut);
  /// The part that a sample (which stands for its class) is in, by its least sample.
  [[nodiscard]] int of(int sample) const { return roots_[sample]; }
  /// How many samples a part has.
  [[nodiscard]] int size(int region) const { return sizes_[region]; }

 private:
  DisjointSets sets_;               // of samples
  std::vector<int> roots_, sizes_;  // [n * n]
  std::vector<char> touched_;       // [n * n] whether cut edges begin there
};

}  // namespace weft
