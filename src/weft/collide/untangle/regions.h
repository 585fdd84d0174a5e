#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/collide/moving_surface.h"
#include "weft/core/disjoint_sets.h"

namespace weft {

/// An edge by its representative samples, ascending.
using CutEdge = std::array<int, 2>;

/// Connected regions of a sheet whose edges are partly cut.
class Regions {
 public:
  /// @param cut  ascending; an edge that is there twice is not cut
  void find(const SurfaceGrid& grid, std::span<const CutEdge> cut);
  /// Region of a representative sample, named by the region's least sample.
  [[nodiscard]] int of(int sample) const { return roots_[sample]; }
  /// Number of representative samples in a region.
  [[nodiscard]] int size(int region) const { return sizes_[region]; }

 private:
  DisjointSets sets_;               // of samples
  std::vector<int> roots_, sizes_;  // [n * n]
  std::vector<char> touched_;       // [n * n] whether cut edges begin there
};

}  // namespace weft
