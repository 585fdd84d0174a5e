#pragma once

#include "weft/cut/disk_mesh.h"

namespace weft {

/// The border position of the first path's first node that gives the least stretch of `count`
/// candidates, spread evenly over one side of the square (turning by a whole side gives the same
/// map, turned). Candidates are judged by the first map of the stretch minimisation, so that
/// all share one factorization.
/// @pre n is large enough for the cut
int choose_rotation(const CutDisk& cut, int size, int count);

}  // namespace weft
