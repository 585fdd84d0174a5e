#pragma once

#include <string>
#include <vector>

#include "weft/view/picture.h"

namespace weft {

/// Part of a figure: a picture with a line of text below it.
struct Panel {
  Picture picture;
  std::string label;
};

/// White between panels [pixels].
inline constexpr int panel_gap = 14;
/// The height of a line of labels, room around it included [pixels].
int label_height(int text_scale);

/// Panels side by side on white, their middles in line. Without any label there is no line for
/// them.
Picture in_a_row(const std::vector<Panel>& panels, int text_scale = 2);
/// Pictures below each other on white.
Picture in_a_column(const std::vector<Picture>& pictures);

}  // namespace weft
