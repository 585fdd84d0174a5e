#pragma once

#include "weft/grid.h"

namespace weft {

/// The area of what a surface covers seen along y, both triangles of each quad, by pixels of a
/// 2048th of its wider side. @param position  [n x n] [m]  @return [m^2]
double shadow_area(const Planes3& position);

}  // namespace weft
