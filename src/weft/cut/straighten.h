#pragma once

#include "weft/cut/cut_graph.h"

namespace weft {

/// Shortens every path of a cut that opens a surface to a disk; the result opens it to a disk too.
///
/// Closing one path of the cut turns the disk into an annulus, whose two borders the path joins.
/// Any simple curve from one border to the other opens the annulus to a disk again, so the shortest
/// such curve replaces the path. Its ends are free along the rest of the cut, which moves nodes too
/// and shortens more than fixed ends would [gu02, section 3.1]. Dangling paths (an end of valence
/// 1) and held paths stay. Rounds over all paths, longest first, end when one gains less than
/// `min_gain` of the whole length.
void straighten(CutGraph& graph, double min_gain = 1e-4);

}  // namespace weft
