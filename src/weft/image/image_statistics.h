#pragma once

#include <array>

#include "weft/image/geometry_image.h"

namespace weft {

/// What the samples of an image tell of it, without the mesh that it came from.
struct ImageStatistics {
  Box3d box;                        ///< of the world positions [m]
  int largest_mate_class = 0;       ///< most samples that are one surface point; 0 without mates
  double stretch_l2 = 0;            ///< of the grid's triangles as a map, scaled as MapQuality is
  double stretch_linf = 0;          ///< the largest
  std::array<int, 2> worst_quad{};  ///< row and column of the quad that has it
  int folded_quads = 0;             ///< whose two triangles face away from each other
  int zero_area_triangles = 0;      ///< [triangles of the grid, exactly]
};
ImageStatistics examine_image(const GeometryImage& image);

}  // namespace weft
