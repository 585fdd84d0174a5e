#pragma once

#include <vector>

#include "weft/cut/disk_mesh.h"

namespace weft {

/// One curve of a cut: a path of the true border, or a path and its mate.
struct BorderCurve {
  int path = 0;       ///< the path, or the lower-numbered of the two
  int weight = 1;     ///< number of times the curve runs along the border: 1, or 2 with a mate
  double length = 0;  ///< [m]
  int least = 1;      ///< minimum number of sample intervals that keeps the topology
  int fixed = 0;      ///< the number of intervals that it has to have; 0: free
};

/// The curves of a cut in the order of their paths, with their minimum intervals: 3 in all on every
/// border loop of the surface and on every curve from a node to itself, 2 on all but the shortest
/// of several curves that join the same two nodes, 1 otherwise. Fewer would collapse a loop or
/// merge two curves.
std::vector<BorderCurve> border_curves(const CutDisk& cut);

/// Positions of the vertices along a path, by arc length: 0 at its first node, `intervals` at its
/// last. Strictly increasing multiples of 2^-32, exact; edges of no length get a small one.
/// @return [edges + 1]
std::vector<double> path_places(const CutDisk& cut, int path, int intervals);

}  // namespace weft
