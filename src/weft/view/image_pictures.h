#pragma once

#include "weft/cut/disk_mesh.h"
#include "weft/image/geometry_image.h"
#include "weft/param/square_map.h"
#include "weft/view/picture.h"

namespace weft {

/// The geometry image itself: x, y, z of the unit cube as red, green, blue, row 0 at the top. Small
/// images are enlarged a whole number of times, without smoothing.
/// @param min_side  sides below it are enlarged to reach it [pixels]
Picture colours_of(const GeometryImage& image, int min_side = 256);

struct MapDrawing {
  int side = 1024;  ///< of the square [pixels]
  bool stretch = true;
  ///< triangles coloured by stretch: blue where the map has room to spare, red where it is short of
  ///< it
  bool edges = true;  ///< of the triangles, as lines
};

/// The parameterization in the square, row v = 0 at the top as in the image.
Picture draw_map(const DiskMesh& disk, const SquareMap& map, const MapDrawing& options = {});

}  // namespace weft
