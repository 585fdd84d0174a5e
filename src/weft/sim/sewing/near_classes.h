#pragma once

#include <vector>

#include "weft/garment.h"

namespace weft {

/// Of each class of sewn samples those that are near it along the threads of the sewn garment laid
/// flat, itself among them, ascending.
/// @param within  the distance [m]
[[nodiscard]] std::vector<std::vector<int>> near_classes(const Garment& garment, double within);

}  // namespace weft
