#include "weft/collide/pairs/local_folds.h"

#include <algorithm>

#include "weft/collide/pairs/unfolded.h"

namespace weft {
namespace {

/// Nodes up to this far apart on their level are looked at as one rectangle.
constexpr int near_nodes = 2;

struct Rectangle {
  int level, first_row, last_row, first_col, last_col;
};

Box3f extent_of(const ExtentLevels& edges, const Rectangle& of) {
  Box3f box = edges.at({of.level, of.first_row, of.first_col});
  for (int r = of.first_row; r <= of.last_row; ++r)
    for (int c = of.first_col; c <= of.last_col; ++c) {
      const Box3f node = edges.at({of.level, r, c});
      box = {min(box.lower, node.lower), max(box.upper, node.upper)};
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
  auto rows = std::minmax({pair.a / side, pair.b / side});
  auto cols = std::minmax({pair.a % side, pair.b % side});
  int level = 0;
  for (; rows.second - rows.first > near_nodes || cols.second - cols.first > near_nodes; ++level) {
    rows = {rows.first / 2, rows.second / 2};
    cols = {cols.first / 2, cols.second / 2};
  }
  const Rectangle both{level, rows.first, rows.second, cols.first, cols.second};
  return certainly_unfolded(extent_of(row_edges_, both), extent_of(column_edges_, both), 2 * slack);
}

}  // namespace weft
