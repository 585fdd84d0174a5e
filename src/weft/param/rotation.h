#pragma once

#include "weft/cut/disk_mesh.h"

namespace weft {

/// The border position of the first path's first node that gives the least stretch of about `count`
/// candidates, spread evenly over one side of the square (turning by a whole side gives the same
/// map, turned), and of the neighbours of the best at half the spacing. Candidates are mapped in
/// full, on a coarser mesh where the disk has more than a few thousand triangles.
/// @pre n is large enough for the cut
int choose_rotation(const CutDisk& cut, int size, int count);

}  // namespace weft
