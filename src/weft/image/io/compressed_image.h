#pragma once

#include <string_view>

#include "weft/geometry_image.h"

namespace weft {

/// What a compressed image begins with.
inline constexpr std::string_view compressed_mark{"WEFTIMG\1", 8};

/// @param bytes  of a file that begins with compressed_mark  @throws InputError
GeometryImage parse_compressed_image(std::string_view bytes, std::string_view where);

}  // namespace weft
