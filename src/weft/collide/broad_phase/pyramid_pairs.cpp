#include "weft/collide/broad_phase/pyramid_pairs.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "weft/collide/contact_pipeline.h"

namespace weft {
namespace {

/// Level of the nodes whose pairs workers share as tasks: 2^4 cells a side.
constexpr int task_level = 4;

/// Nodes of a cloth are compared with slabs from this level down.
constexpr int max_slab_level = 2;
/// Generous bound of the rounding error of a distance along a slab, relative to the nodes' sizes.
constexpr float slab_rounding = 1e-5F;

Node child_of(const Node& node, int k) {
  return {node.level - 1, 2 * node.row + k / 2, 2 * node.col + k % 2};
}
/// Mask of near_pairs of a node with itself that keeps each pair of children once.
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
  const CollideKernels& kernels = collide_kernels_for(team.instructions());
  const auto is_fitted = [&](std::size_t i) {
    return surfaces_[i].name != 0 && surfaces_[i].name == levels_[i].fitted_to;
  };
  bool large = false;
  for (std::size_t i = 0; i < surfaces_.size(); ++i)
    large = large || (!is_fitted(i) && surfaces_[i].grid->cells() >= min_shared_cells);
  team.run_if(large, [&](Worker& worker) {
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
      const MovingSurface& of = surfaces_[i];
      Levels& levels = levels_[i];
      if (is_fitted(i)) continue;
      levels.boxes.fit(of, worker);
      if (i >= cloths_) levels.slabs.fit(kernels, of, worker);
    }
  });
  for (std::size_t i = 0; i < surfaces_.size(); ++i) levels_[i].fitted_to = surfaces_[i].name;
}

bool PyramidPairs::apart_by_slab(const Search& search, const PlacedPair& pair) const {
  const Slab* found = levels_[search.b].slabs.find(pair.nodes.b);
  if (found == nullptr || found->normal == Vec3f{}) return false;
  const Slab& slab = *found;
  const MovingSurface& cloth = surfaces_[search.a];
  const float reach = search.reach + slab_rounding * (longest_side(pair.a) + longest_side(pair.b));
  const Extent start = along_slab(search, *cloth.start, pair.nodes.a, slab);
  const bool above = start.min - slab.upper_start >= reach;
  if (!above && !(slab.lower_start - start.max >= reach)) return false;
  const Extent end = along_slab(search, *cloth.end, pair.nodes.a, slab);
  return (above ? end.min - slab.upper_end : slab.lower_end - end.max) >= reach;
}

Extent PyramidPairs::along_slab(const Search& search, const Planes3& at, const Node& node,
                                const Slab& slab) const {
  const float origin[3] = {slab.origin.x, slab.origin.y, slab.origin.z};
  const float normal[3] = {slab.normal.x, slab.normal.y, slab.normal.z};
  const int n = at.size(), span = 1 << node.level;
  const int first_row = node.row * span, last_row = std::min(n - 1, first_row + span);
  if (span == 1) {
    const auto four = [&](const Grid<float>& plane) {
      const float *above = plane.row(first_row) + node.col, *below = plane.row(last_row) + node.col;
      return std::array{above[0], above[1], below[0], below[1]};
    };
    const std::array x = four(at.x), y = four(at.y), z = four(at.z);
    return search.kernels->along({x.data(), y.data(), z.data(), 0, 1, 4}, origin, normal);
  }
  // The kernel needs four columns at least, a neighbour's if need be.
  const int col = std::min(node.col * span, n - std::max(4, span + 1));
  return search.kernels->along(
      {at.x.row(first_row) + col, at.y.row(first_row) + col, at.z.row(first_row) + col,
       static_cast<long>(at.x.stride()), last_row - first_row + 1, std::max(4, span + 1)},
      origin, normal);
}

template <class Stop, class Emit>
void PyramidPairs::descend(const Search& search, const PlacedPair& pair, const Stop& stop,
                           const Emit& emit) const {
  const auto& [a, b] = pair.nodes;
  if (stop(pair)) return emit(pair);
  const int a_samples = surfaces_[search.a].grid->size();
  const bool split_b = a.level == 0 || (b.level > 0 && longest_side(pair.b) > longest_side(pair.a));
  const bool fits_slab = a.level == 0 || (!split_b && a.level <= max_slab_level && a_samples >= 5);
  const bool body = static_cast<std::size_t>(search.b) >= cloths_;
  if (body && fits_slab && apart_by_slab(search, pair)) return;
  if (a.level == 0 && b.level == 0) return emit(pair);
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
  const int cells = surfaces_[search.a].grid->cells();
  unsigned near =
      search.kernels->near_pairs(levels.boxes.children(a), levels.boxes.children(b), search.reach);
  if (a == b) near &= pairs_once;
  for (; near != 0; near &= near - 1) {
    const int k = std::countr_zero(near);
    const NodePair children{child_of(a, k / 4), child_of(b, k % 4)};
    if (children.a.level == 0 && children.a == children.b) continue;
    if (levels.folds->unfolded(children.a, children.b)) continue;
    if (children.a.level == 0) {
      const auto cell = [&](const Node& node) { return node.row * cells + node.col; };
      if (!levels.folds->unfolded_across({cell(children.a), cell(children.b)})) emit(children);
    } else {
      descend_self(search, children, stop, emit);
    }
  }
}

template <class Descend>
void PyramidPairs::share_out(const Search& search, int tasks, ThreadTeam& team,
                             std::vector<CandidatePair>& out, const Descend& descend) {
  const int cells_a = surfaces_[search.a].grid->cells();
  const int cells_b = surfaces_[search.b].grid->cells();
  shared_.collect(tasks, team, out, [&](int i, std::vector<CandidatePair>& mine) {
    descend(i, [&](const NodePair& pair) {
      const int a = pair.a.row * cells_a + pair.a.col, b = pair.b.row * cells_b + pair.b.col;
      // For a cloth with itself the order of nodes need not be that of cells.
      mine.push_back(search.a == search.b && b < a ? CandidatePair{b, a} : CandidatePair{a, b});
    });
  });
}

void PyramidPairs::find(int surface_a, int surface_b, float reach, ThreadTeam& team,
                        std::vector<CandidatePair>& out) {
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
                             std::vector<CandidatePair>& out) {
  levels_[surface].folds->find_unfolded(surfaces_[surface], slack, team);
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

std::unique_ptr<Collider> make_collider_of(const PyramidOptions& /*options*/,
                                           const Obstacles& obstacles,
                                           std::span<const CollidingCloth> cloths) {
  return make_pipeline<PyramidPairs>(obstacles, cloths);
}

}  // namespace weft
