#pragma once

#include <string_view>

#include "weft/picture.h"
#include "weft/vec.h"

namespace weft {

/// The width and height of a line of text in DejaVu Sans. [pixels] A line is 12 pixels high times
/// `scale`, descenders included.
/// @param text  UTF-8; bytes that are none count as U+FFFD
int text_width(std::string_view text, int scale);
int text_height(int scale);

struct TextPlace {
  int x = 0, y = 0;  ///< upper left corner [pixels]; text is clipped to the picture
  int scale = 1;
};
/// Draws a line of text with smooth edges, nothing without a font (has_font). A character that the
/// font lacks is drawn as a box.
/// @param colour  display space, in [0, 1]
void draw_text(Picture& picture, std::string_view text, TextPlace place, Vec3f colour);

}  // namespace weft
