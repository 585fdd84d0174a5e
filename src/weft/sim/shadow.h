#pragma once

#include "weft/grid.h"

namespace weft {

/// Area of the projection of a surface along y, both triangles of each quad, on a raster of 2048
/// pixels across its wider side. @param position  [n x n] [m]  @return [m^2]
double shadow_area(const Planes3& position);

}  // namespace weft
