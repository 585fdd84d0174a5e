#pragma once

#include "weft/cut/disk_mesh.h"
#include "weft/drawing.h"
#include "weft/param/square_map.h"

namespace weft {

/// Draws the map of a disk, as draw_map of a conversion's result, without need of a border layout.
Picture draw_map(const DiskMesh& disk, const SquareMap& map, const MapDrawing& options = {});

}  // namespace weft
