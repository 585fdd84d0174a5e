#pragma once

#include "weft/cut/disk_mesh.h"

namespace weft {

/// The least n = 2^k + 1 from 33 on that holds a cut well, with twice the border that its paths
/// need at least, and samples enough for the mesh: as many as it has vertices. More than 1025 only
/// where the cut needs them.
int suitable_size(const CutDisk& cut, int vertex_count);

}  // namespace weft
