#include "weft/image/border_walk.h"

#include <algorithm>
#include <cstdint>

#include "weft/core/assert.h"
#include "weft/param/border_layout.h"

namespace weft {

BorderWalk::BorderWalk(const MappedDisk& mapped)
    : size_(mapped.map.size), path_at_(static_cast<std::size_t>(4 * (size_ - 1)), 0) {
  const std::vector<int>& border = mapped.cut.disk.border;
  const int around = 4 * (size_ - 1);
  for (std::size_t p = 0; p < mapped.cut.paths.size(); ++p) {
    const BorderPath& from = mapped.cut.paths[p];
    Path path{mapped.layout.first[p], mapped.layout.intervals[p], from.mate, {}, {}};
    for (int k = 0; k <= from.edges; ++k) {
      const std::size_t i = static_cast<std::size_t>(from.first + k) % border.size();
      const double knot = border_position_of(size_, mapped.map.uv[border[i]]) - path.first;
      path.vertices.push_back(border[i]);
      path.knots.push_back(knot < 0 ? knot + around : knot);
    }
    path.knots.back() = path.intervals;  // 0 where the path runs once around
    for (int k = 0; k < path.intervals; ++k)
      path_at_[(path.first + k) % around] = static_cast<int>(p);
    paths_.push_back(std::move(path));
  }
}

EdgePoint BorderWalk::at(int index, int size) const {
  WEFT_ASSERT(index >= 0 && index < 4 * (size - 1));
  // In units of 1 / (size - 1) sample intervals everything is whole.
  const std::int64_t unit = size - 1;
  const std::int64_t place = std::int64_t{index} * (size_ - 1);
  const Path* path = &paths_[path_at_[place / unit]];
  std::int64_t along = place - path->first * unit;
  if (along < 0) along += 4 * (size_ - 1) * unit;
  if (path->mate >= 0 && &paths_[path->mate] < path) {
    along = path->intervals * unit - along;
    path = &paths_[path->mate];
  }
  const double knot = static_cast<double>(along) / static_cast<double>(unit);
  const auto above = std::upper_bound(path->knots.begin(), path->knots.end(), knot);
  if (above == path->knots.end()) return {path->vertices.back(), path->vertices.back(), 0};
  const auto k = static_cast<std::size_t>(above - path->knots.begin());
  const double low = path->knots[k - 1];
  return {path->vertices[k - 1], path->vertices[k], (knot - low) / (*above - low)};
}

}  // namespace weft
