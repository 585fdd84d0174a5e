#include "weft/convert/border_walk.h"

#include <algorithm>
#include <cstdint>

#include "weft/core/assert.h"
#include "weft/param/border_layout.h"

namespace weft {

BorderWalk::BorderWalk(const MappedDisk& mapped)
    : size_(mapped.map.size), path_at_(static_cast<std::size_t>(size_.around()), 0) {
  const std::vector<int>& border = mapped.cut.disk.border;
  const int around = size_.around();
  for (std::size_t p = 0; p < mapped.cut.paths.size(); ++p) {
    const BorderPath& from = mapped.cut.paths[p];
    Path path{mapped.layout.first[p], mapped.layout.intervals[p], from.mate, {}, {}};
    for (int k = 0; k <= from.edges; ++k) {
      const std::size_t i = static_cast<std::size_t>(from.first + k) % border.size();
      const double knot = border_position_of(size_, mapped.map.uv[border[i]]) - path.first;
      path.vertices.push_back(border[i]);
      path.knots.push_back(knot < 0 ? knot + around : knot);
    }
    path.knots.back() = path.intervals;  // computed as 0 where the path runs once around
    for (int k = 0; k < path.intervals; ++k)
      path_at_[(path.first + k) % around] = static_cast<int>(p);
    paths_.push_back(std::move(path));
  }
}

BorderWalk::PathPoint BorderWalk::find(int index, ChartSize size) const {
  WEFT_ASSERT(index >= 0 && index < size.around());
  WEFT_ASSERT((size.rows - 1) * std::int64_t{size_.cols - 1} ==
              (size.cols - 1) * std::int64_t{size_.rows - 1});
  // In units of 1 / around sample intervals all positions are integers.
  const std::int64_t unit = size.around();
  const std::int64_t place = std::int64_t{index} * size_.around();
  PathPoint point;
  point.path = point.own_path = path_at_[place / unit];
  const Path* path = &paths_[point.path];
  std::int64_t along = place - path->first * unit;
  if (along < 0) along += size_.around() * unit;
  if (path->mate >= 0 && path->mate < point.path) {
    along = path->intervals * unit - along;
    point.path = path->mate;
    path = &paths_[point.path];
  }
  const double knot = static_cast<double>(along) / static_cast<double>(unit);
  const auto above = std::upper_bound(path->knots.begin(), path->knots.end(), knot);
  point.edge = static_cast<int>(above - path->knots.begin()) - 1;
  if (above == path->knots.end()) return point;
  const double low = path->knots[point.edge];
  point.fraction = (knot - low) / (*above - low);
  return point;
}

EdgePoint BorderWalk::at(int index, ChartSize size) const {
  const PathPoint point = find(index, size);
  const std::vector<int>& vertices = paths_[point.path].vertices;
  const std::size_t last = vertices.size() - 1, edge = point.edge;
  return {vertices[edge], vertices[std::min(edge + 1, last)], point.fraction};
}

EdgePoint BorderWalk::on_own_side(int index, ChartSize size) const {
  const PathPoint point = find(index, size);
  if (point.path == point.own_path) return at(index, size);
  // Mates have the same edges in opposite order.
  const std::vector<int>& vertices = paths_[point.own_path].vertices;
  const std::size_t from = vertices.size() - 1 - static_cast<std::size_t>(point.edge);
  return {vertices[from], vertices[from == 0 ? 0 : from - 1], point.fraction};
}

}  // namespace weft
