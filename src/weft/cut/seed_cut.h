#pragma once

#include "weft/cut/cut_graph.h"

namespace weft {

/// Cut by phases one and two of [gu02, section 3.1]: triangles are removed one after the other,
/// starting at a seed, each across the open edge nearest to the seed; then dangling edges are
/// pruned.
///
/// The distance of an edge is the mean of its ends' geodesic distances along edges from the seed's
/// corners. Removing a triangle across its nearest free edge grows a tree in the dual graph. Phase
/// one leaves the edges that the tree does not cross, so a priority queue gives the same result in
/// O(n log n). As the removed triangles form one open disk, the remaining edges are connected and
/// contain every border loop.
/// @param held  edges that stay open whatever the seed; they leave the surface in one piece
CutGraph cut_from_seed(const CutGraph& held, int seed_triangle);

/// Triangles far from each other, the first of them `first`: each further one touches the vertex
/// farthest from those before it. At most `count`, fewer on a tiny mesh.
std::vector<int> spread_triangles(const CutSurface& surface, int first, int count);

}  // namespace weft
