#include "weft/collide/pairs/pyramid_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "weft/collide/pairs/unfolded.h"

namespace weft {
namespace {

/// Pairs of nodes up to this far apart on their level are looked at as one rectangle.
constexpr int near_nodes = 2;
/// What workers share are nodes of about this many cells a side.
constexpr int task_level = 3;

Box3f join(const Box3f& a, const Box3f& b) {
  return {min(a.lower, b.lower), max(a.upper, b.upper)};
}

/// The extents of the rectangle of nodes that holds both; false where it is too large to be worth
/// looking at.
struct Rectangle {
  int level, first_row, last_row, first_col, last_col;
};
Rectangle rectangle_of(const Node& a, const Node& b) {
  return {a.level, std::min(a.row, b.row), std::max(a.row, b.row), std::min(a.col, b.col),
          std::max(a.col, b.col)};
}
Box3f extent_of(const ExtentLevels& levels, const Rectangle& of) {
  Box3f box = levels.at({of.level, of.first_row, of.first_col});
  for (int r = of.first_row; r <= of.last_row; ++r)
    for (int c = of.first_col; c <= of.last_col; ++c) box = join(box, levels.at({of.level, r, c}));
  return box;
}

}  // namespace

PyramidPairs::PyramidPairs(std::span<const SurfaceGrid* const> grids, std::size_t cloths)
    : cloths_(cloths) {
  for (std::size_t i = 0; i < grids.size(); ++i) {
    const int cells = grids[i]->cells();
    levels_.emplace_back();
    levels_.back().boxes = ExtentLevels(cells);
    if (i < cloths) {
      levels_.back().row_edges = ExtentLevels(cells);
      levels_.back().column_edges = ExtentLevels(cells);
      levels_.back().flat_windows = Grid<float>(cells, cells);
    } else {
      levels_.back().slabs = SlabLevels(cells);
    }
  }
}

void PyramidPairs::refit(std::span<const MovingSurface> surfaces, ThreadTeam& team) {
  surfaces_.assign(surfaces.begin(), surfaces.end());
  team.run([&](Worker& worker) {
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
      const MovingSurface& of = surfaces_[i];
      Levels& levels = levels_[i];
      const bool still = of.start == of.end;
      if (levels.fitted && still) continue;
      fill_position_extents(*of.start, *of.end, levels.boxes, worker);
      levels.boxes.fit(worker);
      if (i < cloths_) {
        fill_edge_extents(EdgeWay::along_row, *of.start, *of.end, levels.row_edges, worker);
        levels.row_edges.fit(worker);
        fill_edge_extents(EdgeWay::along_column, *of.start, *of.end, levels.column_edges, worker);
        levels.column_edges.fit(worker);
      } else {
        levels.slabs.fit(of, worker);
      }
    }
  });
  for (std::size_t i = 0; i < cloths_; ++i) levels_[i].windows_slack = -1;
  for (std::size_t i = cloths_; i < surfaces_.size(); ++i)
    levels_[i].fitted = surfaces_[i].start == surfaces_[i].end;
}

bool PyramidPairs::apart(const Search& search, const NodePair& pair) const {
  const Box3f &a = levels_[search.a].boxes.at(pair.a), &b = levels_[search.b].boxes.at(pair.b);
  return !overlap(a, b, search.reach);
}

bool PyramidPairs::apart_by_slab(const Search& search, const NodePair& pair) const {
  const Slab& slab = levels_[search.b].slabs.at(pair.b);
  if (slab.normal == Vec3d{}) return false;
  const MovingSurface& cloth = surfaces_[search.a];
  double least_start = HUGE_VAL, most_start = -HUGE_VAL;
  double least_end = HUGE_VAL, most_end = -HUGE_VAL;
  for (const int r : {pair.a.row, pair.a.row + 1})
    for (const int c : {pair.a.col, pair.a.col + 1}) {
      const double start = dot(slab.normal, vec_cast<double>(cloth.start->at(r, c)));
      const double end = dot(slab.normal, vec_cast<double>(cloth.end->at(r, c)));
      least_start = std::min(least_start, start);
      most_start = std::max(most_start, start);
      least_end = std::min(least_end, end);
      most_end = std::max(most_end, end);
    }
  const double reach = search.reach;
  return (least_start - slab.upper_start >= reach && least_end - slab.upper_end >= reach) ||
         (slab.lower_start - most_start >= reach && slab.lower_end - most_end >= reach);
}

void PyramidPairs::find_flat_windows(int surface, float slack, ThreadTeam& team) {
  Levels& levels = levels_[surface];
  if (levels.windows_slack == slack) return;
  levels.windows_slack = slack;
  team.run([&](Worker& worker) {
    const Range mine = worker.share(levels.boxes.sides().front() - 1);
    for (int r = mine.first; r < mine.last; ++r)
      find_unfolded_windows(levels.row_edges, levels.column_edges, r, 2 * slack,
                            levels.flat_windows.row(r));
  });
}

bool PyramidPairs::flat_window(int surface, int row, int col) const {
  const Grid<float>& windows = levels_[surface].flat_windows;
  return row >= 0 && col >= 0 && row + 1 < windows.rows() && col + 1 < windows.cols() &&
         windows(row, col) != 0;
}

bool PyramidPairs::neighbours_unfolded(int surface, const Node& a, const Node& b) const {
  const int row = std::min(a.row, b.row), col = std::min(a.col, b.col);
  return flat_window(surface, row, col) || (a.row == b.row && flat_window(surface, row - 1, col)) ||
         (a.col == b.col && flat_window(surface, row, col - 1));
}

bool PyramidPairs::unfolded(const Search& search, const NodePair& pair) const {
  if (pair.a.level == 0) {
    const bool side_by_side =
        std::abs(pair.a.row - pair.b.row) <= 1 && std::abs(pair.a.col - pair.b.col) <= 1;
    return side_by_side && neighbours_unfolded(search.a, pair.a, pair.b);
  }
  if (std::abs(pair.a.row - pair.b.row) > near_nodes ||
      std::abs(pair.a.col - pair.b.col) > near_nodes)
    return false;
  const Rectangle both = rectangle_of(pair.a, pair.b);
  const Levels& levels = levels_[search.a];
  return certainly_unfolded(extent_of(levels.row_edges, both), extent_of(levels.column_edges, both),
                            2 * search.slack);
}

template <class Stop, class Emit>
void PyramidPairs::descend(const Search& search, const NodePair& pair, const Stop& stop,
                           const Emit& emit) const {
  if (apart(search, pair)) return;
  if (stop(pair)) return emit(pair);
  const bool body = static_cast<std::size_t>(search.b) >= cloths_;
  if (pair.a.level == 0 && body && apart_by_slab(search, pair)) return;
  if (pair.a.level == 0 && pair.b.level == 0) return emit(pair);
  const Levels &a = levels_[search.a], &b = levels_[search.b];
  const bool split_b =
      pair.a.level == 0 ||
      (pair.b.level > 0 && longest_side(b.boxes.at(pair.b)) > longest_side(a.boxes.at(pair.a)));
  if (split_b) {
    for_children(pair.b, b.boxes.sides(), [&](const Node& child) {
      descend(search, {pair.a, child}, stop, emit);
    });
  } else {
    for_children(pair.a, a.boxes.sides(), [&](const Node& child) {
      descend(search, {child, pair.b}, stop, emit);
    });
  }
}

template <class Stop, class Emit>
void PyramidPairs::descend_self(const Search& search, const NodePair& pair, const Stop& stop,
                                const Emit& emit) const {
  const bool same = pair.a == pair.b;
  if (same && pair.a.level == 0) return;  // the two triangles of a cell share an edge
  if (!same && apart(search, pair)) return;
  if (unfolded(search, pair)) return;
  if (stop(pair) || (pair.a.level == 0 && !same)) return emit(pair);
  const std::vector<int>& sides = levels_[search.a].boxes.sides();
  for_children(pair.a, sides, [&](const Node& first) {
    for_children(pair.b, sides, [&](const Node& second) {
      const bool twice =
          same && (second.row < first.row || (second.row == first.row && second.col < first.col));
      if (!twice) descend_self(search, {first, second}, stop, emit);
    });
  });
}

template <class Descend>
void PyramidPairs::share_out(const Search& search, ThreadTeam& team, std::vector<CellPair>& out,
                             const Descend& descend) {
  const int cells_a = surfaces_[search.a].grid->cells();
  const int cells_b = surfaces_[search.b].grid->cells();
  shared_.collect(
      static_cast<int>(tasks_.size()), team, out, [&](int i, std::vector<CellPair>& mine) {
        descend(tasks_[i], [&](const NodePair& pair) {
          const int a = pair.a.row * cells_a + pair.a.col, b = pair.b.row * cells_b + pair.b.col;
          // Of a cloth with itself the order of nodes need not be that of cells.
          mine.push_back(search.a == search.b && b < a ? CellPair{b, a} : CellPair{a, b});
        });
      });
}

void PyramidPairs::find(int surface_a, int surface_b, float reach, ThreadTeam& team,
                        std::vector<CellPair>& out) {
  const Search search{surface_a, surface_b, reach, 0};
  const auto never = [](const NodePair&) { return false; };
  const int stop_level = std::min(task_level, levels_[surface_a].boxes.top());
  tasks_.clear();
  descend(
      search, {{levels_[surface_a].boxes.top(), 0, 0}, {levels_[surface_b].boxes.top(), 0, 0}},
      [&](const NodePair& pair) { return pair.a.level <= stop_level; },
      [&](const NodePair& pair) { tasks_.push_back(pair); });
  share_out(search, team, out,
            [&](const NodePair& task, const auto& emit) { descend(search, task, never, emit); });
}

void PyramidPairs::find_self(int surface, float reach, float slack, ThreadTeam& team,
                             std::vector<CellPair>& out) {
  find_flat_windows(surface, slack, team);
  const Search search{surface, surface, reach, slack};
  const auto never = [](const NodePair&) { return false; };
  const Node root{levels_[surface].boxes.top(), 0, 0};
  const int stop_level = std::min(task_level, root.level);
  tasks_.clear();
  descend_self(
      search, {root, root}, [&](const NodePair& pair) { return pair.a.level <= stop_level; },
      [&](const NodePair& pair) { tasks_.push_back(pair); });
  share_out(search, team, out, [&](const NodePair& task, const auto& emit) {
    descend_self(search, task, never, emit);
  });
}

}  // namespace weft
