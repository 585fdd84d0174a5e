#include "weft/collide/pairs/pyramid_pairs.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace weft {
namespace {

/// What workers share are nodes of about this many cells a side.
constexpr int task_level = 4;

Node child_of(const Node& node, int k) {
  return {node.level - 1, 2 * node.row + k / 2, 2 * node.col + k % 2};
}
/// Of the pairs of a node's children with each other, as near_pairs tells them: each once.
constexpr unsigned pairs_once = 0x8CEF;

}  // namespace

PyramidPairs::PyramidPairs(std::span<const SurfaceGrid* const> grids, std::size_t cloths)
    : cloths_(cloths) {
  for (std::size_t i = 0; i < grids.size(); ++i) {
    const int cells = grids[i]->cells();
    levels_.emplace_back();
    levels_.back().boxes = PathBoxLevels(cells);
    if (i < cloths) {
      levels_.back().folds.emplace(cells);
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
      levels.boxes.fit(of, worker);
      if (i >= cloths_) levels.slabs.fit(of, worker);
    }
  });
  for (std::size_t i = cloths_; i < surfaces_.size(); ++i)
    levels_[i].fitted = surfaces_[i].start == surfaces_[i].end;
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

template <class Stop, class Emit>
void PyramidPairs::descend(const Search& search, const PlacedPair& pair, const Stop& stop,
                           const Emit& emit) const {
  const auto& [a, b] = pair.nodes;
  if (stop(pair)) return emit(pair);
  const bool body = static_cast<std::size_t>(search.b) >= cloths_;
  if (a.level == 0 && body && apart_by_slab(search, pair.nodes)) return;
  if (a.level == 0 && b.level == 0) return emit(pair);
  const bool split_b = a.level == 0 || (b.level > 0 && longest_side(pair.b) > longest_side(pair.a));
  const PathBoxLevels& levels = levels_[split_b ? search.b : search.a].boxes;
  const ChildPathBoxes& children = levels.children(split_b ? b : a);
  unsigned near = search.kernels->near_children(split_b ? pair.a : pair.b, children, search.reach);
  for (; near != 0; near &= near - 1) {
    const int k = std::countr_zero(near);
    if (split_b) {
      descend(search, {{a, child_of(b, k)}, pair.a, child_box(children, k)}, stop, emit);
    } else {
      descend(search, {{child_of(a, k), b}, child_box(children, k), pair.b}, stop, emit);
    }
  }
}

template <class Stop, class Emit>
void PyramidPairs::descend_self(const Search& search, const NodePair& pair, const Stop& stop,
                                const Emit& emit) const {
  const auto& [a, b] = pair;
  if (stop(pair)) return emit(pair);
  if (a.level == 0) return;  // the two triangles of a cell share an edge
  const Levels& levels = levels_[search.a];
  unsigned near =
      search.kernels->near_pairs(levels.boxes.children(a), levels.boxes.children(b), search.reach);
  if (a == b) near &= pairs_once;
  for (; near != 0; near &= near - 1) {
    const int k = std::countr_zero(near);
    const NodePair children{child_of(a, k / 4), child_of(b, k % 4)};
    if (children.a.level == 0 && children.a == children.b) continue;
    if (levels.folds->unfolded(children.a, children.b)) continue;
    if (children.a.level == 0) {
      emit(children);
    } else {
      descend_self(search, children, stop, emit);
    }
  }
}

template <class Descend>
void PyramidPairs::share_out(const Search& search, int tasks, ThreadTeam& team,
                             std::vector<CellPair>& out, const Descend& descend) {
  const int cells_a = surfaces_[search.a].grid->cells();
  const int cells_b = surfaces_[search.b].grid->cells();
  shared_.collect(tasks, team, out, [&](int i, std::vector<CellPair>& mine) {
    descend(i, [&](const NodePair& pair) {
      const int a = pair.a.row * cells_a + pair.a.col, b = pair.b.row * cells_b + pair.b.col;
      // Of a cloth with itself the order of nodes need not be that of cells.
      mine.push_back(search.a == search.b && b < a ? CellPair{b, a} : CellPair{a, b});
    });
  });
}

void PyramidPairs::find(int surface_a, int surface_b, float reach, ThreadTeam& team,
                        std::vector<CellPair>& out) {
  const Search search{&collide_kernels_for(team.instructions()), surface_a, surface_b, reach};
  const PathBoxLevels &a = levels_[surface_a].boxes, &b = levels_[surface_b].boxes;
  const int stop_level = std::min(task_level, a.top());
  tasks_.clear();
  descend(
      search, {{{a.top(), 0, 0}, {b.top(), 0, 0}}, a.root_box(), b.root_box()},
      [&](const PlacedPair& pair) { return pair.nodes.a.level <= stop_level; },
      [&](const PlacedPair& pair) { tasks_.push_back(pair); });
  share_out(search, static_cast<int>(tasks_.size()), team, out, [&](int task, const auto& emit) {
    descend(
        search, tasks_[task], [](const PlacedPair&) { return false; },
        [&](const PlacedPair& pair) { emit(pair.nodes); });
  });
}

void PyramidPairs::find_self(int surface, float reach, float slack, ThreadTeam& team,
                             std::vector<CellPair>& out) {
  levels_[surface].folds->judge(surfaces_[surface], slack, team);
  const Search search{&collide_kernels_for(team.instructions()), surface, surface, reach};
  const Node root{levels_[surface].boxes.top(), 0, 0};
  const int stop_level = std::min(task_level, root.level);
  self_tasks_.clear();
  descend_self(
      search, {root, root}, [&](const NodePair& pair) { return pair.a.level <= stop_level; },
      [&](const NodePair& pair) { self_tasks_.push_back(pair); });
  share_out(search, static_cast<int>(self_tasks_.size()), team, out,
            [&](int task, const auto& emit) {
              descend_self(
                  search, self_tasks_[task], [](const NodePair&) { return false; }, emit);
            });
}

}  // namespace weft
