#pragma once

#include <string_view>

#include "weft/picture.h"
#include "weft/vec.h"

namespace weft {

/// The width and height of a line of text [pixels]: characters are 5 x 9 (two rows for descenders)
/// at a spacing of 6, times `scale`.
int text_width(std::string_view text, int scale);
int text_height(int scale);

struct TextPlace {
  int x = 0, y = 0;  ///< upper left corner [pixels]; text is clipped to the picture
  int scale = 1;
};
/// Draws text into a picture in a small built-in font: digits, letters without accents, and
/// . , - + % : = / ( ) _. A character that the font lacks is left blank. Above scale 1 edges are
/// smooth.
/// @param colour  display space, in [0, 1]
void draw_text(Picture& picture, std::string_view text, TextPlace place, Vec3f colour);

}  // namespace weft
