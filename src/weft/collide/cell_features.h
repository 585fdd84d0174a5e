#pragma once

#include <vector>

namespace weft {

class SurfaceGrid;

/// The corners and edges of a surface that belong to one of its cells in a search for contacts.
struct CellFeatures {
  /// Edges of a cell: from corner 0 to 1, from 0 to 2, its diagonal, from 2 to 3 and from 1 to 3.
  static constexpr int edges = 5;
  /// The first of those at its last row and column, which kernels leave out: mostly they are
  /// another cell's.
  static constexpr int last_edges = 3;

  unsigned char own_corners = 0;  ///< bit k: corner k
  unsigned char own_edges = 0;    ///< bit k: edge k
  bool at_seam = false;           ///< whether a corner has mates, also such as it is being sewn to
};

/// Gives every point and every edge of a surface to one of the cells that have it, [(n - 1)^2]:
/// mostly to the one that it begins, and at the last row and column of a chart, where none does, to
/// the one that it ends. Cells in no chart and edges of length zero have none.
std::vector<CellFeatures> assign_features(const SurfaceGrid& grid);

}  // namespace weft
