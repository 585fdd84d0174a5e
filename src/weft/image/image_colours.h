#pragma once

#include <string_view>

#include "weft/geometry_image.h"

namespace weft {

/// Refuses colours of another size than the image's or outside of [0, 1].
/// @param name  of the image in the error  @throws InputError
void check_colours(const GeometryImage& image, std::string_view name);

/// Gives mates and holes the colours of their representatives: other programs may have changed
/// some.
void join_colours(GeometryImage& image);

}  // namespace weft
