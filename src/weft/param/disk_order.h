#pragma once

#include <span>
#include <vector>

#include "weft/cut/disk_mesh.h"
#include "weft/param/border_relaxation.h"

namespace weft {

/// A disk whose vertices and triangles are numbered so that neighbours lie near each other in
/// memory. What walks over a surface too large for the caches then waits for memory far less.
struct OrderedDisk {
  DiskMesh disk;            ///< without surface triangles and splits
  std::vector<int> vertex;  ///< [D] index in the disk that was ordered
};

/// Triangles breadth first from the border's first edge, vertices as those come to them.
OrderedDisk breadth_first(const DiskMesh& disk);

/// Freedoms of another numbering. @param number  [D] of each vertex its new index
std::vector<BorderFreedom> renumbered(std::span<const BorderFreedom> freedoms,
                                      std::span<const int> number);

}  // namespace weft
