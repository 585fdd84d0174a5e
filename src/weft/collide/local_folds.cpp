#include "weft/collide/local_folds.h"

#include <algorithm>
#include <cstdlib>

#include "weft/collide/unfolded.h"

namespace weft {
namespace {

/// Farther apart in the image, cells share no sample.
constexpr int near_cells = 2;

struct Cells {
  int first_row, last_row, first_col, last_col;
};

Box3f extent_of(const ExtentLevels& edges, const Cells& of) {
  Box3f box = edges.at({0, of.first_row, of.first_col});
  for (int r = of.first_row; r <= of.last_row; ++r)
    for (int c = of.first_col; c <= of.last_col; ++c) {
      const Box3f cell = edges.at({0, r, c});
      box = {min(box.lower, cell.lower), max(box.upper, cell.upper)};
    }
  return box;
}

}  // namespace

void LocalFolds::fit(const MovingSurface& surface, Worker& worker) {
  fill_edge_extents(EdgeWay::along_row, *surface.start, *surface.end, row_edges_, worker);
  row_edges_.fit(worker);
  fill_edge_extents(EdgeWay::along_column, *surface.start, *surface.end, column_edges_, worker);
  column_edges_.fit(worker);
}

bool LocalFolds::unfolded(const CellPair& pair, float slack) const {
  const int side = row_edges_.sides().front();
  const auto rows = std::minmax({pair.a / side, pair.b / side});
  const auto cols = std::minmax({pair.a % side, pair.b % side});
  if (rows.second - rows.first > near_cells || cols.second - cols.first > near_cells) return false;
  const Cells both{rows.first, rows.second, cols.first, cols.second};
  return certainly_unfolded(extent_of(row_edges_, both), extent_of(column_edges_, both), 2 * slack);
}

}  // namespace weft
