#include "weft/collide/extent_levels.h"

namespace weft {
namespace {

inline float least(float a, float b) { return a < b ? a : b; }
inline float largest(float a, float b) { return a > b ? a : b; }

struct Coordinate {
  const Grid<float>*start, *end;
};
std::array<Coordinate, 3> coordinates(const Planes3& start, const Planes3& end) {
  return {Coordinate{&start.x, &end.x}, {&start.y, &end.y}, {&start.z, &end.z}};
}

/// least and largest of four rows' neighbours: a cell's corners at both ends of the step.
void cell_row(int cells, const Coordinate& of, int r, float* lower, float* upper) {
  const float *a = of.start->row(r), *b = of.start->row(r + 1);
  const float *c = of.end->row(r), *d = of.end->row(r + 1);
#pragma omp simd
  for (int i = 0; i < cells; ++i) {
    lower[i] = least(least(least(a[i], a[i + 1]), least(b[i], b[i + 1])),
                     least(least(c[i], c[i + 1]), least(d[i], d[i + 1])));
    upper[i] = largest(largest(largest(a[i], a[i + 1]), largest(b[i], b[i + 1])),
                       largest(largest(c[i], c[i + 1]), largest(d[i], d[i + 1])));
  }
}

void row_edges(int cells, const Coordinate& of, int r, float* lower, float* upper) {
  const float *a = of.start->row(r), *b = of.start->row(r + 1);
  const float *c = of.end->row(r), *d = of.end->row(r + 1);
#pragma omp simd
  for (int i = 0; i < cells; ++i) {
    const float p = a[i + 1] - a[i], q = b[i + 1] - b[i];
    const float s = c[i + 1] - c[i], t = d[i + 1] - d[i];
    lower[i] = least(least(p, q), least(s, t));
    upper[i] = largest(largest(p, q), largest(s, t));
  }
}

void column_edges(int cells, const Coordinate& of, int r, float* lower, float* upper) {
  const float *a = of.start->row(r), *b = of.start->row(r + 1);
  const float *c = of.end->row(r), *d = of.end->row(r + 1);
#pragma omp simd
  for (int i = 0; i < cells; ++i) {
    const float p = b[i] - a[i], q = b[i + 1] - a[i + 1];
    const float s = d[i] - c[i], t = d[i + 1] - c[i + 1];
    lower[i] = least(least(p, q), least(s, t));
    upper[i] = largest(largest(p, q), largest(s, t));
  }
}

template <class Row>
void fill(const Row& row, const Planes3& start, const Planes3& end, ExtentLevels& levels,
          Worker& worker) {
  const int cells = levels.sides().front();
  const auto all = coordinates(start, end);
  const Range mine = worker.share(cells);
  for (int r = mine.first; r < mine.last; ++r)
    for (std::size_t k = 0; k < 3; ++k)
      row(cells, all[k], r, levels.finest()[k].row(r), levels.finest()[k + 3].row(r));
  worker.barrier();
}

/// A row of the next coarser level; `second` is null where the finer has no such row.
template <class Pick>
void halve_row(const Pick& pick, int fine_cols, const float* first, const float* second,
               float* out) {
  const int pairs = fine_cols / 2;
  for (int c = 0; c < pairs; ++c)
    out[c] = pick(pick(first[2 * c], first[2 * c + 1]), pick(second[2 * c], second[2 * c + 1]));
  if (fine_cols % 2 != 0) out[pairs] = pick(first[fine_cols - 1], second[fine_cols - 1]);
}

/// Levels of fewer nodes than this a side are fitted by one worker.
constexpr int least_shared_side = 32;

}  // namespace

ExtentLevels::ExtentLevels(int cells) : sides_(level_sides(cells)) {
  for (const int side : sides_) {
    levels_.emplace_back();
    for (Grid<float>& plane : levels_.back()) plane = Grid<float>(side, side);
  }
}

void ExtentLevels::fit(Worker& worker) {
  for (std::size_t l = 1; l < levels_.size(); ++l) {
    const int fine = sides_[l - 1], side = sides_[l];
    const bool shared = side >= least_shared_side;
    if (!shared && worker.rank() != 0) break;
    const Range mine = shared ? worker.share(side) : Range{0, side};
    for (int r = mine.first; r < mine.last; ++r)
      for (std::size_t k = 0; k < 6; ++k) {
        const Grid<float>& from = levels_[l - 1][k];
        const float* first = from.row(2 * r);
        const float* second = 2 * r + 1 < fine ? from.row(2 * r + 1) : first;
        float* out = levels_[l][k].row(r);
        if (k < 3) {
          halve_row(least, fine, first, second, out);
        } else {
          halve_row(largest, fine, first, second, out);
        }
      }
    if (shared) worker.barrier();
  }
  worker.barrier();
}

void fill_position_extents(const Planes3& start, const Planes3& end, ExtentLevels& levels,
                           Worker& worker) {
  fill(cell_row, start, end, levels, worker);
}

void fill_edge_extents(EdgeWay way, const Planes3& start, const Planes3& end, ExtentLevels& levels,
                       Worker& worker) {
  if (way == EdgeWay::along_row) {
    fill(row_edges, start, end, levels, worker);
  } else {
    fill(column_edges, start, end, levels, worker);
  }
}

}  // namespace weft
