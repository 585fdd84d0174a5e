#include "weft/collide/pairs/slab_levels.h"

#include <algorithm>

namespace weft {
namespace {

/// Coarser nodes are too bent for a slab to be worth its fitting.
constexpr int most_levels = 7;

Vec3d place(const Planes3& planes, int row, int col) {
  return vec_cast<double>(planes.at(row, col));
}

/// Twice the area vector of a cell.
Vec3d cell_normal(const Planes3& p, int row, int col) {
  return cross(place(p, row, col + 1) - place(p, row + 1, col),
               place(p, row + 1, col + 1) - place(p, row, col));
}

}  // namespace

SlabLevels::SlabLevels(int cells) : sides_(level_sides(cells)) {
  for (const int side : sides_) levels_.emplace_back(static_cast<std::size_t>(side) * side);
}

void SlabLevels::fit(const MovingSurface& surface, Worker& worker) {
  const int levels = std::min(most_levels, static_cast<int>(sides_.size()));
  for (int l = 0; l < levels; ++l) {
    const Range mine = worker.share(sides_[l]);
    for (int r = mine.first; r < mine.last; ++r)
      for (int c = 0; c < sides_[l]; ++c) fit_node(surface, {l, r, c});
  }
  worker.barrier();
}

void SlabLevels::fit_node(const MovingSurface& surface, const Node& node) {
  const int first_row = node.row << node.level, first_col = node.col << node.level;
  const int cells = sides_.front();
  const int last_row = std::min(cells, first_row + (1 << node.level));
  const int last_col = std::min(cells, first_col + (1 << node.level));
  Slab& own = slab(node);
  Vec3d sum;
  for (int r = first_row; r < last_row; ++r)
    for (int c = first_col; c < last_col; ++c) sum += cell_normal(*surface.start, r, c);
  own = {};
  own.normal = vec_cast<float>(normalized(sum));
  own.origin = surface.start->at(first_row, first_col);
  const Vec3d normal = vec_cast<double>(own.normal), origin = vec_cast<double>(own.origin);
  double lower_start = HUGE_VAL, upper_start = -HUGE_VAL;
  double lower_end = HUGE_VAL, upper_end = -HUGE_VAL;
  for (int r = first_row; r <= last_row; ++r)
    for (int c = first_col; c <= last_col; ++c) {
      const double start = dot(normal, place(*surface.start, r, c) - origin);
      lower_start = std::min(lower_start, start);
      upper_start = std::max(upper_start, start);
      if (surface.end == surface.start) continue;
      const double end = dot(normal, place(*surface.end, r, c) - origin);
      lower_end = std::min(lower_end, end);
      upper_end = std::max(upper_end, end);
    }
  if (surface.end == surface.start) {
    lower_end = lower_start;
    upper_end = upper_start;
  }
  own.lower_start = static_cast<float>(lower_start);
  own.upper_start = static_cast<float>(upper_start);
  own.lower_end = static_cast<float>(lower_end);
  own.upper_end = static_cast<float>(upper_end);
}

}  // namespace weft
