#pragma once

#include "weft/garment/panel_outline.h"

namespace weft {

/// Chooses which four border points of a panel are the corners of its rectangle: sharp corners of
/// the outline, with opposite sides about equally long, for as many samples on both. Rows then run
/// along the grain as nearly as they can. Sets start, rows and cols.
/// @param progress  told nothing but that work goes on; may be null
void choose_corners(PanelOutline& outline, Progress* progress = nullptr);

}  // namespace weft
