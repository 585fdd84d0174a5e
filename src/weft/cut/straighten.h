#pragma once

#include "weft/cut/cut_graph.h"

namespace weft {

/// Shortens every path of a cut that opens a surface to a disk; the result opens it to a disk too.
///
/// Closing one path of the cut turns the disk into an annulus, of which the path joins the two
/// borders. Any simple curve from one of these borders to the other opens the annulus to a disk
/// again, so the path gives way to the shortest of them: its ends may slide along the rest of the
/// cut, by which nodes move too, further than with ends that are held [gu02, section 3.1]. Paths
/// that dangle (an end of valence 1) or are held stay. Paths are taken longest first, until a round
/// gains less than `min_gain` of the whole length.
void straighten(CutGraph& graph, double min_gain = 1e-4);

}  // namespace weft
