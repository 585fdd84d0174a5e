#pragma once

#include "weft/cut/disk_mesh.h"

namespace weft {

/// Stage 6: splits every chord, an interior edge between two border vertices, at its midpoint. A
/// triangle with three border vertices on one side of the square would have no area; afterwards
/// every triangle has an interior vertex, unless it is the whole disk. The border does not change;
/// new vertices come last and get surface ids of their own.
/// @return number of edges split
int split_chords(DiskMesh& disk);

}  // namespace weft
