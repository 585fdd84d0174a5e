#include "weft/collide/broad_phase/node_levels.h"

#include <algorithm>

#include "weft/collide/broad_phase/min_max.h"

namespace weft {
namespace {

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

}  // namespace weft
