#include "weft/collide/broad_phase/node_levels.h"

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
      found = {std::min(found.min, distance), std::max(found.max, distance)};
    }
  return found;
}

inline float min(float a, float b) { return a < b ? a : b; }
inline float max(float a, float b) { return a > b ? a : b; }

struct Coordinate {
  const Grid<float>*start, *end;
};
std::array<Coordinate, 3> coordinates(const Planes3& start, const Planes3& end) {
  return {Coordinate{&start.x, &end.x}, {&start.y, &end.y}, {&start.z, &end.z}};
}

/// Minima and maxima of one coordinate over a row of cells: their corners at both ends of the step.
void cell_row(int cells, const Coordinate& of, int r, float* lower, float* upper) {
  const float *a = of.start->row(r), *b = of.start->row(r + 1);
  const float *c = of.end->row(r), *d = of.end->row(r + 1);
  for (int i = 0; i < cells; ++i) {
    lower[i] = min(min(min(a[i], a[i + 1]), min(b[i], b[i + 1])),
                   min(min(c[i], c[i + 1]), min(d[i], d[i + 1])));
    upper[i] = max(max(max(a[i], a[i + 1]), max(b[i], b[i + 1])),
                   max(max(c[i], c[i + 1]), max(d[i], d[i + 1])));
  }
}

}  // namespace

std::vector<int> level_sides(int cells) {
  std::vector<int> sides{cells};
  while (sides.back() > 1) sides.push_back((sides.back() + 1) / 2);
  return sides;
}

ExtentLevels::ExtentLevels(int cells) : sides_(level_sides(cells)) {
  for (Grid<float>& plane : finest_) plane = Grid<float>(cells, cells);
  for (const int side : sides_) boxes_.emplace_back(static_cast<std::size_t>(side) * side);
}

void ExtentLevels::pack_row(int row) {
  const int cells = sides_.front();
  const auto& [x0, y0, z0, x1, y1, z1] = finest_;
  Box3f* out = &boxes_.front()[static_cast<std::size_t>(row) * cells];
  for (int c = 0; c < cells; ++c)
    out[c] = {{x0.row(row)[c], y0.row(row)[c], z0.row(row)[c]},
              {x1.row(row)[c], y1.row(row)[c], z1.row(row)[c]}};
}

void ExtentLevels::fit_row(std::size_t level, int row) {
  const int fine = sides_[level - 1], side = sides_[level];
  const Box3f* first = &boxes_[level - 1][static_cast<std::size_t>(2 * row) * fine];
  const Box3f* second = 2 * row + 1 < fine ? first + fine : first;
  Box3f* out = &boxes_[level][static_cast<std::size_t>(row) * side];
  for (int c = 0; c < side; ++c) {
    const int left = 2 * c, right = 2 * c + 1 < fine ? left + 1 : left;
    out[c] = {min(min(first[left].lower, first[right].lower),
                  min(second[left].lower, second[right].lower)),
              max(max(first[left].upper, first[right].upper),
                  max(second[left].upper, second[right].upper))};
  }
}

void ExtentLevels::fit(Worker& worker) {
  const Range rows = worker.share(sides_.front());
  for (int r = rows.first; r < rows.last; ++r) pack_row(r);
  fit_levels(sides_, worker,
             [&](int level, int row) { fit_row(static_cast<std::size_t>(level), row); });
  worker.barrier();
}

void fill_position_extents(const Planes3& start, const Planes3& end, ExtentLevels& levels,
                           Worker& worker) {
  const int cells = levels.sides().front();
  const auto all = coordinates(start, end);
  const Range mine = worker.share(cells);
  for (int r = mine.first; r < mine.last; ++r)
    for (std::size_t k = 0; k < 3; ++k)
      cell_row(cells, all[k], r, levels.finest()[k].row(r), levels.finest()[k + 3].row(r));
  worker.barrier();
}

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
  own.lower_start = start.min;
  own.upper_start = start.max;
  own.lower_end = end.min;
  own.upper_end = end.max;
}

}  // namespace weft
