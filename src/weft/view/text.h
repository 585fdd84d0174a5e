#pragma once

#include <string_view>

#include "weft/picture.h"
#include "weft/vec.h"

namespace weft {

/// The size of a line of text, in pixels: characters are 5 x 9 (two rows for
/// what reaches below the line) and stand 6 apart, times `scale`.
int text_width(std::string_view text, int scale);
int text_height(int scale);

struct TextPlace {
  int x = 0, y = 0;  ///< of the upper left corner [pixels]; what falls outside is left out
  int scale = 1;
};
/// Writes into a picture in a small font of our own: digits, letters without accents, and
/// . , - + % : = / ( ) _. A character that it lacks leaves its room empty. Above scale 1 its edges
/// are smooth.
/// @param colour  display space, in [0, 1]
void draw_text(Picture& picture, std::string_view text, TextPlace place, Vec3f colour);

}  // namespace weft
