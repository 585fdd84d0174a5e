#pragma once

#include <span>

#include "weft/picture.h"
#include "weft/vec.h"

namespace weft {

/// Fills what lies inside a closed outline (even-odd), with smooth edges.
/// @param corners  [pixels], x to the right, y down, (0, 0) the upper left corner of the picture
/// @param colour   display space
void fill_polygon(Picture& picture, std::span<const Vec2d> corners, Vec3f colour);

/// Draws a line with round ends and joints. @param width  [pixels]
void draw_line(Picture& picture, std::span<const Vec2d> points, double width, Vec3f colour);

}  // namespace weft
