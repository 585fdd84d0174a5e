#pragma once

#include "weft/cut/disk_mesh.h"
#include "weft/drawing.h"
#include "weft/param/square_map.h"

namespace weft {

/// As draw_map of a conversion's result, for a disk whose border has no layout.
Picture draw_map(const DiskMesh& disk, const SquareMap& map, const MapDrawing& options = {});

}  // namespace weft
