#pragma once

#include "weft/cut/disk_mesh.h"

namespace weft {

/// Stage 6: splits, at its midpoint, every interior edge whose two ends lie on the border. Three
/// border vertices on one side of the square would collapse their triangle; afterwards every
/// triangle has a vertex inside or lies between two border edges and none else. The border stays as
/// it is; new vertices come last and get surface ids of their own.
/// @return how many edges were split
int split_chords(DiskMesh& disk);

}  // namespace weft
