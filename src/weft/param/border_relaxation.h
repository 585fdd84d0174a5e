#pragma once

#include <span>
#include <vector>

#include "weft/param/border_layout.h"

namespace weft {

/// A border vertex that may move along its side of the chart, and the mate that moves with it so
/// that both stay at exactly corresponding positions.
struct BorderFreedom {
  int vertex = 0;  ///< disk vertex
  int axis = 0;    ///< the side runs along u (0) or v (1)
  int mate = -1;   ///< disk vertex; -1: true border
  int mate_axis = 0;
  double sign = 1;    ///< along its side the mate is at offset + sign * (vertex along its side)
  double offset = 0;  ///< a whole number
};

/// The freedom of every border vertex that is neither a node nor at a corner of the chart (nor its
/// mate), once for both mates. Vertices next to an edge of no length are excluded: the smallest
/// displacement would degenerate a triangle there.
/// @param t  [border.size()] border positions, see border_positions
std::vector<BorderFreedom> border_freedoms(const CutDisk& cut, const BorderLayout& layout,
                                           std::span<const double> t);

/// Rounds the vertex of every freedom to the nearest multiple of 2^-32 along its side, and sets its
/// mate to the corresponding position, exactly.
/// @param uv  [D]
void snap_to_grid(std::span<const BorderFreedom> freedoms, std::span<Vec2d> uv);

}  // namespace weft
