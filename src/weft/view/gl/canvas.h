#pragma once

#include <array>

#include "weft/picture.h"
#include "weft/view/gl/objects.h"

namespace weft::gl {

/// A framebuffer with colour and depth.
struct Canvas {
  Framebuffer target;
  Renderbuffer colour, depth;
};
/// @param count  samples a pixel; 0 for one without averaging
/// @param size   width and height [pixels]
/// @throws Error when the driver cannot draw pictures of this size
Canvas make_canvas(int count, std::array<int, 2> size);

/// Reads the pixels of a framebuffer, top row first. @param name  0: the window's own
/// @param size  width and height [pixels]
Picture read_picture(GLuint name, std::array<int, 2> size);

}  // namespace weft::gl
