#include "weft/cloth/multigrid/filter_rows.h"

#include <algorithm>

#include "weft/cloth/neighbours.h"
#include "weft/core/thread_team.h"

namespace weft {
namespace {

/// line += k (x over one of the neighbours of every sample - x). Differences, since the weight of a
/// particle drowns in the sum of its springs' stiffness.
void add_neighbour(const float* k, ConstRow3 here, ConstRow3 there, Range columns, Line3 line) {
#pragma omp simd
  for (int c = columns.first; c < columns.last; ++c) {
    line.x[c] += k[c] * (there.x[c] - here.x[c]);
    line.y[c] += k[c] * (there.y[c] - here.y[c]);
    line.z[c] += k[c] * (there.z[c] - here.z[c]);
  }
}

ConstRow3 shifted(ConstRow3 row, int by) { return {row.x + by, row.y + by, row.z + by}; }

}  // namespace

void residual_row(const FilterLevel& level, const Planes3& x, const Planes3& right, int row,
                  Line3 line) {
  const int n = level.size();
  const ConstRow3 here = row_of(x, row), b = row_of(right, row);
  const float* weight = level.own_weight.row(row);
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    line.x[c] = b.x[c] - weight[c] * here.x[c];
    line.y[c] = b.y[c] - weight[c] * here.y[c];
    line.z[c] = b.z[c] - weight[c] * here.z[c];
  }
  const int directions = level.second[0].rows() > 0 ? 6 : 4;
  for (const NeighbourRow& to : NeighbourRows(n, row)) {
    if (to.direction >= directions) continue;
    const Grid<float>& edges =
        to.direction < 4 ? level.edge[to.direction] : level.second[to.direction - 4];
    add_neighbour(edges.row(to.spring_row) + to.spring_shift, here,
                  shifted(row_of(x, to.other_row), to.shift), {to.first, to.last}, line);
  }
}

}  // namespace weft
