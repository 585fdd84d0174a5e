#pragma once

#include <string>
#include <vector>

#include "weft/view/surface_drawing.h"

namespace weft::figures {

/// Part of a figure: a picture with a line of text below it.
struct Panel {
  Picture picture;
  std::string label;
};

/// Panels side by side on white, their tops in line.
Picture in_a_row(const std::vector<Panel>& panels);
/// Pictures below each other on white.
Picture in_a_column(const std::vector<Picture>& pictures);

/// A drawing on white, as figures show surfaces.
Picture draw_on_white(SurfaceDrawing drawing, const ViewFrom& view);

}  // namespace weft::figures
