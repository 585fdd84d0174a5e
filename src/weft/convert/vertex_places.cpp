#include "weft/convert/vertex_places.h"

#include <cmath>
#include <limits>
#include <utility>

namespace weft {

std::vector<Vec2d> vertex_places(const MappedDisk& mapped, std::span<const int> source_vertex,
                                 int vertices) {
  constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
  const std::vector<int>& points = mapped.cut.disk.surface_vertex;
  std::vector<Vec2d> places(static_cast<std::size_t>(vertices), Vec2d{nowhere, nowhere});
  for (std::size_t d = 0; d < points.size(); ++d) {
    // From there on they came from splitting edges.
    if (std::cmp_greater_equal(points[d], source_vertex.size())) continue;
    Vec2d& place =
        places[static_cast<std::size_t>(source_vertex[static_cast<std::size_t>(points[d])])];
    if (!std::isfinite(place.x)) place = mapped.map.uv[d];
  }
  return places;
}

}  // namespace weft
