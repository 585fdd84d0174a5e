#pragma once

#include <span>
#include <vector>

#include "weft/garment/panel_outline.h"
#include "weft/geometry_image.h"

namespace weft {

/// Places a rectangle for each panel in the smallest square image that they fit in one after the
/// other, the highest first, with at least two samples between them (LevelLayout::gap).
/// @return in the panels' order, without names  @param size  set to the image's
std::vector<Chart> pack_panels(std::span<const PanelOutline> outlines, int& size);

}  // namespace weft
