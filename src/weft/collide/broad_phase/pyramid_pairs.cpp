#include "weft/collide/broad_phase/pyramid_pairs.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "weft/collide/contact_pipeline.h"

namespace weft {
namespace {

/// Fewest samples a side of a cloth that is compared with slabs.
constexpr int min_slab_size = 5;
/// Generous bound of the rounding error of a distance along a slab, relative to the nodes' sizes.
constexpr float slab_rounding = 1e-5F;

Node child_of(const Node& node, int k) {
  return {node.level - 1, 2 * node.row + k / 2, 2 * node.col + k % 2};
}
Node ancestor_of(const Node& node, int level) {
  return {level, node.row >> (level - node.level), node.col >> (level - node.level)};
}
Node first_cell_of(const Node& node) { return {0, node.row << node.level, node.col << node.level}; }
bool may_meet(const PathBox& a, const PathBox& b, float reach) {
  for (int k = 0; k < 3; ++k) {
    const float above =
        std::min(a.lower_start[k] - b.upper_start[k], a.lower_end[k] - b.upper_end[k]);
    const float below =
        std::min(b.lower_start[k] - a.upper_start[k], b.lower_end[k] - a.upper_end[k]);
    if (std::max(above, below) > reach) return false;
  }
  return true;
}

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

bool PyramidPairs::apart_by_slab(const Patch& patch, const Node& node, const PathBox& box) const {
  const Search& search = patch.search;
  if (static_cast<std::size_t>(search.b) < cloths_) return false;
  const Slab* found = levels_[search.b].slabs.find(node);
  if (found == nullptr || found->normal == Vec3f{}) return false;
  const Slab& slab = *found;
  const MovingSurface& cloth = surfaces_[search.a];
  if (cloth.grid->size() < min_slab_size) return false;
  const float reach = search.reach + slab_rounding * (longest_side(patch.box) + longest_side(box));
  const Extent start = along_slab(search, *cloth.start, patch.node, slab);
  const bool above = start.min - slab.upper_start >= reach;
  if (!above && !(slab.lower_start - start.max >= reach)) return false;
  const Extent end = along_slab(search, *cloth.end, patch.node, slab);
  return (above ? end.min - slab.upper_end : slab.lower_end - end.max) >= reach;
}

Extent PyramidPairs::along_slab(const Search& search, const Planes3& at, const Node& node,
                                const Slab& slab) const {
  const float origin[3] = {slab.origin.x, slab.origin.y, slab.origin.z};
  const float normal[3] = {slab.normal.x, slab.normal.y, slab.normal.z};
  const int n = at.size(), span = 1 << node.level;
  const int first_row = node.row * span, last_row = std::min(n - 1, first_row + span);
  // The kernel needs four columns at least, a neighbour's if need be.
  const int col = std::min(node.col * span, n - std::max(4, span + 1));
  return search.kernels->along(
      {at.x.row(first_row) + col, at.y.row(first_row) + col, at.z.row(first_row) + col,
       static_cast<long>(at.x.stride()), last_row - first_row + 1, std::max(4, span + 1)},
      origin, normal);
}

bool PyramidPairs::leaves_out(const Patch& patch, const Node& node, const PathBox& box) const {
  const Search& search = patch.search;
  // A surface of fewer cells than a patch is one.
  const int level = std::max(node.level, PatchMotion::level), above = level - PatchMotion::level;
  if (!patch.changed &&
      search.changed->b->version(Node{level, node.row, node.col}) <= search.changed->since)
    return true;
  if (!search.same()) return apart_by_slab(patch, node, box);
  // Of two patches the later one is found by the earlier one.
  const unsigned last = ((place_in_order(node.row, node.col) + 1) << (2 * above)) - 1;
  return last < patch.place ||
         levels_[search.a].folds->unfolded(ancestor_of(patch.node, node.level), node);
}

void PyramidPairs::descend(const Patch& patch, const Node& node, const PathBox& box) const {
  if (leaves_out(patch, node, box)) return;
  if (node.level <= PatchMotion::level) return pair_cells(patch, node);
  const ChildPathBoxes& children = levels_[patch.search.b].boxes.children(node);
  unsigned near = patch.search.kernels->near_children(patch.box, children, patch.search.reach);
  for (; near != 0; near &= near - 1) {
    const int k = std::countr_zero(near);
    descend(patch, child_of(node, k), child_box(children, k));
  }
}

unsigned PyramidPairs::wanted_cells(int surface, const Node& cell, const Node& tile,
                                    unsigned near) const {
  const UnfoldedWindows& folds = *levels_[surface].folds;
  const int cells = levels_[surface].boxes.sides().front(), number = cell.row * cells + cell.col;
  const bool same_patch =
      ancestor_of(cell, PatchMotion::level) == ancestor_of(tile, PatchMotion::level);
  unsigned wanted = 0;
  for_lanes(near, [&](int lane) {
    const Node node{0, tile.row + lane / Tiling::cols, tile.col + lane % Tiling::cols};
    const int other = node.row * cells + node.col;
    // Of a patch with itself each pair once; the two triangles of a cell share an edge.
    if (same_patch && other <= number) return;
    if (!folds.unfolded(cell, node) &&
        !folds.unfolded(ancestor_of(cell, 1), ancestor_of(node, 1)) &&
        !folds.unfolded_across({number, other}))
      wanted |= 1U << lane;
  });
  return wanted;
}

void PyramidPairs::pair_cells(const Patch& patch, const Node& node) const {
  const Search& search = patch.search;
  const PathBoxLevels& boxes = levels_[search.b].boxes;
  const Node first = first_cell_of(patch.node), first_b = first_cell_of(node);
  const int last_row = std::min(boxes.sides().front(), first_b.row + Tiling::patch_side);
  std::array<unsigned, patch_cells> near;
  for (int row = first_b.row; row < last_row; row += Tiling::rows) {
    search.kernels->near_cells(patch.cells, boxes.tile(row, first_b.col), search.reach,
                               near.data());
    for (int i = 0; i < patch_cells; ++i) {
      if (near[i] == 0) continue;
      const Node cell{0, first.row + i / Tiling::patch_side, first.col + i % Tiling::patch_side};
      const Node tile{0, row, first_b.col};
      const unsigned wanted = search.same() ? wanted_cells(search.a, cell, tile, near[i]) : near[i];
      if (wanted != 0)
        patch.out.push_back(
            {static_cast<std::uint16_t>(cell.row), static_cast<std::uint16_t>(cell.col),
             static_cast<std::uint16_t>(tile.row), static_cast<std::uint16_t>(tile.col),
             static_cast<std::uint8_t>(wanted)});
    }
  }
}

void PyramidPairs::search_patch(const Search& search, int patch,
                                std::vector<CandidateTile>& out) const {
  const ChangedPatches* changed = search.changed;
  const bool own = changed == nullptr || changed->a->version(patch) > changed->since;
  if (!own && changed->b->latest() <= changed->since) return;
  const PathBoxLevels &of_a = levels_[search.a].boxes, &of_b = levels_[search.b].boxes;
  const int patches = Tiling(of_a.sides().front()).patches();
  const Node node{std::min(PatchMotion::level, of_a.top()), patch / patches, patch % patches};
  const PathBox box = of_a.box_of(node);
  if (!may_meet(box, of_b.root_box(), search.reach)) return;
  const Node first = first_cell_of(node);
  descend({search, node, box, of_a.patch(first.row, first.col), place_in_order(node.row, node.col),
           own, out},
          {of_b.top(), 0, 0}, of_b.root_box());
}

void PyramidPairs::search_all(const Search& search, ThreadTeam& team,
                              std::vector<CandidateTile>& out) {
  const PathBoxLevels &a = levels_[search.a].boxes, &b = levels_[search.b].boxes;
  if (!may_meet(a.root_box(), b.root_box(), search.reach)) return;
  const Node root{a.top(), 0, 0};
  if (search.same() && levels_[search.a].folds->unfolded(root, root)) return;
  const int patches = Tiling(a.sides().front()).patches();
  found_.fill(patches * patches, team, [&](int patch, std::vector<CandidateTile>& mine) {
    search_patch(search, patch, mine);
  });
  append(found_, out);
}

void PyramidPairs::find(int surface_a, int surface_b, float reach, ThreadTeam& team,
                        std::vector<CandidateTile>& out) {
  search_all({&collide_kernels_for(team.instructions()), surface_a, surface_b, reach}, team, out);
}

void PyramidPairs::find_self(int surface, float reach, float slack, ThreadTeam& team,
                             std::vector<CandidateTile>& out) {
  levels_[surface].folds->find_unfolded(surfaces_[surface], slack, team);
  search_all({&collide_kernels_for(team.instructions()), surface, surface, reach}, team, out);
}

bool PyramidPairs::find_changed(int surface_a, int surface_b, float reach, float slack,
                                const ChangedPatches& changed, ThreadTeam& team,
                                std::vector<CandidateTile>& out) {
  if (surface_a == surface_b)
    levels_[surface_a].folds->find_unfolded(surfaces_[surface_a], slack, team);
  search_all({&collide_kernels_for(team.instructions()), surface_a, surface_b, reach, &changed},
             team, out);
  return true;
}

std::unique_ptr<Collider> make_collider_of(const PyramidOptions& /*options*/,
                                           const Obstacles& obstacles,
                                           std::span<const CollidingCloth> cloths) {
  return make_pipeline<PyramidPairs>(obstacles, cloths);
}

}  // namespace weft
