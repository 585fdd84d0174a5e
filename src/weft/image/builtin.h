#pragma once

#include <string_view>

#include "weft/geometry_image.h"

namespace weft {

/// The shapes that are images by nature (sheet, disk, torus, cylinder), sampled directly.
/// sheet: a flat 1 m square in the xz plane centred on the origin, u along x, v along z.
/// @throws UsageError when `name` is not one of them
GeometryImage make_image_shape(std::string_view name, int size);

}  // namespace weft
