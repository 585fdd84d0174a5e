#include "weft/collide/broad_phase/slab_levels.h"

#include <algorithm>

namespace weft {
namespace {

Vec3d place(const Planes3& planes, int row, int col) {
  return vec_cast<double>(planes.at(row, col));
}

/// The samples of a node: rows and columns, first and last.
struct NodeSamples {
  int first_row, last_row, first_col, last_col;

  NodeSamples(const Node& node, int cells)
      : first_row(node.row << node.level),
        last_row(std::min(cells, first_row + (1 << node.level))),
        first_col(node.col << node.level),
        last_col(std::min(cells, first_col + (1 << node.level))) {}
};

Extent along(const CollideKernels& kernels, const Planes3& at, const NodeSamples& samples,
             const Slab& slab) {
  const float origin[3] = {slab.origin.x, slab.origin.y, slab.origin.z};
  const float normal[3] = {slab.normal.x, slab.normal.y, slab.normal.z};
  const auto cols = samples.last_col - samples.first_col + 1;
  Extent found{HUGE_VALF, -HUGE_VALF};
  if (cols >= 4)
    return kernels.along(
        {at.x.row(samples.first_row) + samples.first_col,
         at.y.row(samples.first_row) + samples.first_col,
         at.z.row(samples.first_row) + samples.first_col, static_cast<long>(at.x.stride()),
         samples.last_row - samples.first_row + 1, cols},
        origin, normal);
  for (int r = samples.first_row; r <= samples.last_row; ++r)
    for (int c = samples.first_col; c <= samples.last_col; ++c) {
      const float distance = dot(slab.normal, at.at(r, c) - slab.origin);
      found = {std::min(found.least, distance), std::max(found.largest, distance)};
    }
  return found;
}

}  // namespace

SlabLevels::SlabLevels(int cells) : sides_(level_sides(cells)) {
  for (int level = 0; level <= std::min(max_level, top()); ++level) {
    const auto nodes = static_cast<std::size_t>(sides_[level]) * sides_[level];
    levels_.emplace_back(level == 0 ? 0 : nodes);
    areas_.emplace_back(level == 0 ? 0 : nodes);
  }
}

void SlabLevels::fit(const CollideKernels& kernels, const MovingSurface& surface, Worker& worker) {
  for (int l = 1; l < static_cast<int>(levels_.size()); ++l) {
    const Range mine = worker.share(sides_[l]);
    for (int r = mine.first; r < mine.last; ++r)
      for (int c = 0; c < sides_[l]; ++c) fit_node(kernels, surface, {l, r, c});
    worker.barrier();
  }
}

Vec3d SlabLevels::area_of(const Planes3& at, const Node& node) const {
  if (node.level > 0) return areas_[node.level][index_of(node)];
  const int row = node.row, col = node.col;
  return cross(place(at, row, col + 1) - place(at, row + 1, col),
               place(at, row + 1, col + 1) - place(at, row, col));
}

void SlabLevels::fit_node(const CollideKernels& kernels, const MovingSurface& surface,
                          const Node& node) {
  Vec3d area;
  for_children(node, sides_, [&](const Node& child) { area += area_of(*surface.start, child); });
  areas_[node.level][index_of(node)] = area;
  const NodeSamples samples(node, sides_.front());
  Slab& own = levels_[node.level][index_of(node)];
  own = {};
  own.normal = vec_cast<float>(normalized(area));
  own.origin = surface.start->at(samples.first_row, samples.first_col);
  const Extent start = along(kernels, *surface.start, samples, own);
  const Extent end =
      surface.end == surface.start ? start : along(kernels, *surface.end, samples, own);
  own.lower_start = start.least;
  own.upper_start = start.largest;
  own.lower_end = end.least;
  own.upper_end = end.largest;
}

}  // namespace weft
