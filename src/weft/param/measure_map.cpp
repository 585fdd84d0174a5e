#include "weft/core/orientation.h"
#include "weft/mesh/stretch.h"
#include "weft/param/square_map.h"

namespace weft {

MapQuality measure_map(const DiskMesh& disk, const SquareMap& map) {
  MapQuality quality;
  for (const auto& [a, b, c] : disk.triangles) {
    const int sign = orientation(map.uv[a], map.uv[b], map.uv[c]);
    quality.flipped += sign < 0 ? 1 : 0;
    quality.degenerate += sign == 0 ? 1 : 0;
  }
  const Stretch stretch =
      measure_stretch(surface_triangles(disk.positions, disk.triangles), disk.triangles, map.uv);
  quality.stretch_l2 = stretch.l2;
  quality.stretch_linf = stretch.linf;
  return quality;
}

}  // namespace weft
