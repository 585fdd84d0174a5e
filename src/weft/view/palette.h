#pragma once

#include "weft/core/vec.h"
#include "weft/view/picture.h"

namespace weft {

// Colours of drawings, display space, each channel in [0, 1], unless said otherwise.

/// From blue over white to red as the stretch goes from a quarter over one to four.
Vec3f stretch_colour(double stretch);
/// From pale yellow over red to nearly black as a share goes from 0 to 1.
Vec3f amount_colour(double share);
/// Colours that are told apart well, one for each curve of a cut.
Vec3f curve_colour(int index);
/// What the renderer takes, about: linear light.
Vec3f linear_light(Vec3f display);

/// No-op outside the picture.
void set_pixel(Picture& picture, int x, int y, Vec3f colour);
/// A picture of one colour.
Picture blank_picture(int width, int height, Vec3f colour);
/// Copies a picture into another, its upper left corner at (x, y); what falls outside is left out.
void paste(Picture& picture, const Picture& part, int x, int y);

}  // namespace weft
