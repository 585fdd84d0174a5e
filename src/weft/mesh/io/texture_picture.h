#pragma once

#include <string_view>

#include "weft/mesh_colours.h"

namespace weft {

/// Reads a PNG or JPEG picture of any kind as 8-bit RGB; what shines through is drawn opaque.
/// @param name  what errors call it
/// @throws InputError for another format, a damaged picture, or one of more than 2^26 pixels
TexturePicture decode_texture(std::string_view bytes, std::string_view name);

}  // namespace weft
