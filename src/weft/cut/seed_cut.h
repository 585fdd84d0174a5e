#pragma once

#include "weft/cut/cut_graph.h"

namespace weft {

/// Phases one and two of [gu02, section 3.1]: triangles are removed one after the other from a seed
/// on, each across the edge nearest to the seed, then what dangles is pruned.
///
/// The distance of an edge is the mean of its ends' geodesic distances along edges from the seed's
/// corners. Removing a triangle across its nearest free edge grows a tree over the dual graph; the
/// edges it does not cross are what phase one leaves, so a queue gives the same result in O(n log
/// n). As the removed triangles form one open disk, what is left is connected and holds every
/// border loop.
/// @param held  edges that are open whatever the seed; they leave the surface in one piece
CutGraph cut_from_seed(const CutGraph& held, int seed_triangle);

/// Triangles that lie far from each other, the first among them `first`: each further one touches
/// the vertex farthest from all before. At most `count`, fewer on a tiny mesh.
std::vector<int> spread_triangles(const CutSurface& surface, int first, int count);

}  // namespace weft
