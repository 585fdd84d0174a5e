#include "weft/collide/broad_phase/pyramid_pairs.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

#include "weft/collide/contact_pipeline.h"

namespace weft {
namespace {

Node child_of(const Node& node, int k) {
  return {node.level - 1, 2 * node.row + k / 2, 2 * node.col + k % 2};
}
Node ancestor_of(const Node& node, int level) {
  return {level, node.row >> (level - node.level), node.col >> (level - node.level)};
}
Node first_cell_of(const Node& node) { return {0, node.row << node.level, node.col << node.level}; }
/// Those cells of a tile, which begins at a cell, that are neighbours of a cell along the surface.
unsigned neighbours_in(const Node& cell, const Node& tile) {
  constexpr int near = UnfoldedWindows::neighbours;
  const int first = std::max(0, cell.col - near - tile.col),
            last = std::min(Tiling::cols - 1, cell.col + near - tile.col);
  if (last < first) return 0;
  const unsigned cols = ((1U << (last - first + 1)) - 1) << first;
  unsigned found = 0;
  for (int r = 0; r < Tiling::rows; ++r)
    if (std::abs(tile.row + r - cell.row) <= near) found |= cols << (Tiling::cols * r);
  return found;
}
/// Drops pairs in unfolded windows across seams. @param first  of the candidates
void drop_unfolded_across(const UnfoldedWindows& folds, int cells, std::size_t first,
                          std::vector<CandidateTile>& out) {
  const Tiling tiling(cells);
  for (std::size_t i = first; i < out.size(); ++i) {
    CandidateTile& one = out[i];
    for_lanes(one.cells, [&](int lane) {
      if (folds.unfolded_across({tiling.cell_at(one.row_a, one.col_a), tiling.cell_b(one, lane)}))
        one.cells &= static_cast<std::uint8_t>(~(1U << lane));
    });
  }
  out.erase(std::remove_if(out.begin() + static_cast<std::ptrdiff_t>(first), out.end(),
                           [](const CandidateTile& one) { return one.cells == 0; }),
            out.end());
}
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

PyramidPairs::PyramidPairs(std::span<const SurfaceGrid* const> grids, std::size_t /*cloths*/) {
  for (const SurfaceGrid* grid : grids) {
    levels_.emplace_back();
    levels_.back().boxes = PathBoxLevels(grid->cells());
  }
}

void PyramidPairs::refit(std::span<const MovingSurface> surfaces, ThreadTeam& team) {
  surfaces_.assign(surfaces.begin(), surfaces.end());
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
    }
  });
  for (std::size_t i = 0; i < surfaces_.size(); ++i) levels_[i].fitted_to = surfaces_[i].name;
}

bool PyramidPairs::leaves_out(const Patch& patch, const Node& node) const {
  const Search& search = patch.search;
  // A surface of fewer cells than a patch is one.
  const int level = std::max(node.level, PatchVersions::level),
            above = level - PatchVersions::level;
  if (!patch.changed &&
      search.changed->b->of(Node{level, node.row, node.col}) <= search.changed->since)
    return true;
  if (!search.same()) return false;
  // Of two patches the later one is found by the earlier one.
  const unsigned last = ((place_in_order(node.row, node.col) + 1) << (2 * above)) - 1;
  if (last < patch.place || search.unfolded->unfolded(ancestor_of(patch.node, node.level), node))
    return true;
  return node.level == PatchVersions::level && patch.node.level == PatchVersions::level &&
         search.unfolded->patches_unfolded_across(patch.node, node);
}

void PyramidPairs::descend(const Patch& patch, const Node& node) const {
  if (leaves_out(patch, node)) return;
  if (node.level <= PatchVersions::level) return pair_cells(patch, node);
  const ChildPathBoxes& children = levels_[patch.search.b].boxes.children(node);
  unsigned near = patch.search.kernels->near_children(patch.box, children, patch.search.reach);
  for (; near != 0; near &= near - 1) {
    const int k = std::countr_zero(near);
    descend(patch, child_of(node, k));
  }
}

unsigned PyramidPairs::wanted_cells(const UnfoldedWindows& unfolded, const Node& cell,
                                    const Node& tile, unsigned near) {
  const bool same_patch =
      ancestor_of(cell, PatchVersions::level) == ancestor_of(tile, PatchVersions::level);
  unsigned wanted = 0;
  for_lanes(near & ~neighbours_in(cell, tile), [&](int lane) {
    const Node node{0, tile.row + lane / Tiling::cols, tile.col + lane % Tiling::cols};
    // Of a patch with itself each pair once.
    if (same_patch && std::pair(node.row, node.col) < std::pair(cell.row, cell.col)) return;
    if (!unfolded.unfolded(ancestor_of(cell, 1), ancestor_of(node, 1))) wanted |= 1U << lane;
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
      const unsigned wanted =
          search.same() ? wanted_cells(*search.unfolded, cell, tile, near[i]) : near[i];
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
  const bool own = changed == nullptr || changed->a->of(patch) > changed->since;
  if (!own && changed->b->latest() <= changed->since) return;
  const PathBoxLevels &of_a = levels_[search.a].boxes, &of_b = levels_[search.b].boxes;
  const int patches = Tiling(of_a.sides().front()).patches();
  const Node node{std::min(PatchVersions::level, of_a.top()), patch / patches, patch % patches};
  const PathBox box = of_a.box_of(node);
  if (!may_meet(box, of_b.root_box(), search.reach)) return;
  const Node first = first_cell_of(node);
  descend({search, node, box, of_a.patch(first.row, first.col), place_in_order(node.row, node.col),
           own, out},
          {of_b.top(), 0, 0});
}

void PyramidPairs::search_all(const Search& search, ThreadTeam& team,
                              std::vector<CandidateTile>& out) {
  const PathBoxLevels &a = levels_[search.a].boxes, &b = levels_[search.b].boxes;
  if (!may_meet(a.root_box(), b.root_box(), search.reach)) return;
  if (search.same() && search.unfolded->all_unfolded()) return;
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
  std::optional<UnfoldedWindows>& made = levels_[surface].folds;
  if (!made) made.emplace(levels_[surface].boxes.sides().front());
  UnfoldedWindows& folds = *made;
  folds.find_unfolded(surfaces_[surface], slack, team);
  const std::size_t first = out.size();
  search_all({&collide_kernels_for(team.instructions()), surface, surface, reach, &folds}, team,
             out);
  drop_unfolded_across(folds, levels_[surface].boxes.sides().front(), first, out);
  const SurfaceGrid& grid = *surfaces_[surface].grid;
  found_.fill(grid.cells(), team, [&](int row, std::vector<CandidateTile>& mine) {
    folds.find_folded_neighbours(grid, row, mine);
  });
  append(found_, out);
}

bool PyramidPairs::find_changed(int surface_a, int surface_b, float reach,
                                const ChangedPatches& changed, ThreadTeam& team,
                                std::vector<CandidateTile>& out) {
  search_all({&collide_kernels_for(team.instructions()), surface_a, surface_b, reach,
              changed.unfolded, &changed},
             team, out);
  return true;
}

std::unique_ptr<Collider> make_collider_of(const PyramidOptions& /*options*/,
                                           const Obstacles& obstacles,
                                           std::span<const CollidingCloth> cloths) {
  return make_pipeline<PyramidPairs>(obstacles, cloths);
}

}  // namespace weft
