#pragma once

#include "weft/cut/disk_mesh.h"

namespace weft {

/// Inserts a vertex into the border edge that starts at `border_index`, and one at the same place
/// into the edge's mate, where it has one: both are one new surface point with equal bits. Indices
/// into the border and the paths' firsts are renewed; a mate that stands earlier in the border
/// shifts them by one more.
/// @param fraction  where on the edge, in (0, 1) from its start
void split_border_edge(CutDisk& cut, int border_index, double fraction);

/// The path that has the border edge that starts at `border_index`.
int path_of_border_edge(const CutDisk& cut, int border_index);

}  // namespace weft
