#pragma once

#include <array>
#include <bit>
#include <vector>

#include "weft/collide/broad_phase/candidate_pairs.h"
#include "weft/collide/broad_phase/chunks.h"
#include "weft/collide/kernels/collide_kernels.h"
#include "weft/collide/moving_surface.h"
#include "weft/core/thread_team.h"

namespace weft {

/// The tiles of 2 x 4 cells of a surface, numbered row by row, and its patches, nodes of 4 x 4
/// cells that hold two tiles.
class Tiling {
 public:
  static constexpr int rows = 2, cols = 4, patch_side = PatchMotion::side;
  Tiling() = default;
  /// @param cells  a side
  explicit Tiling(int cells)
      : cells_(cells),
        tile_rows_((cells + rows - 1) / rows),
        patches_((cells + patch_side - 1) / patch_side) {}
  [[nodiscard]] int cells() const { return cells_; }                 ///< a side
  [[nodiscard]] int count() const { return tile_rows_ * patches_; }  ///< of tiles
  [[nodiscard]] int patches() const { return patches_; }             ///< a side
  [[nodiscard]] int tile_of(int cell) const {
    return cell / cells_ / rows * patches_ + cell % cells_ / cols;
  }
  /// Place of a cell in its tile, row by row.
  [[nodiscard]] int lane_of(int cell) const {
    return cell / cells_ % rows * cols + cell % cells_ % cols;
  }
  [[nodiscard]] int cell(int tile, int lane) const {
    return (first_row(tile) + lane / cols) * cells_ + first_col(tile) + lane % cols;
  }
  [[nodiscard]] int first_row(int tile) const { return tile / patches_ * rows; }
  [[nodiscard]] int first_col(int tile) const { return tile % patches_ * cols; }
  [[nodiscard]] int patch_of(int cell) const {
    return cell / cells_ / patch_side * patches_ + cell % cells_ / patch_side;
  }

 private:
  int cells_ = 0, tile_rows_ = 0, patches_ = 0;
};

/// Place of a node among those of its level in the order in which a pyramid is descended.
[[nodiscard]] unsigned place_in_order(int row, int col);

/// Calls visit(pair) for the pairs of a cell with cells of a tile.
/// @param of_tile  the tiling of the tile's surface
template <class Visit>
void for_pairs(const CandidateTile& found, const Tiling& of_tile, const Visit& visit) {
  for (unsigned left = found.cells; left != 0; left &= left - 1)
    visit(CandidatePair{found.cell, of_tile.cell(found.tile, std::countr_zero(left))});
}

/// Joins pairs of cells into tiles, ordered by cells, then tiles.
/// @param pairs  each once; reordered
void join_to_tiles(const Tiling& of_first, const Tiling& of_second,
                   std::vector<CandidatePair>& pairs, std::vector<CandidateTile>& out);

/// Collects pairs that a team finds, as tiles.
class SharedPairs {
 public:
  /// Calls find(i, mine) for i in 0 .. count - 1, which adds pairs to `mine`, and adds all to
  /// `out`.
  template <class Find>
  void collect(int count, std::array<Tiling, 2> tilings, ThreadTeam& team,
               std::vector<CandidateTile>& out, const Find& find) {
    found_.fill(count, team, find);
    pairs_.clear();
    append(found_, pairs_);
    join_to_tiles(tilings[0], tilings[1], pairs_, out);
  }

 private:
  ChunkedLists<std::vector<CandidatePair>> found_;
  std::vector<CandidatePair> pairs_;
};

/// The corners of a surface's cells at both ends of a step, tile by tile, so that one cell is
/// compared with those of a whole tile at once.
class CellTiles {
 public:
  /// @param grid  kept by reference
  explicit CellTiles(const SurfaceGrid& grid);
  /// Takes a step's motion, to be fitted when it is asked for.
  void take(const MovingSurface& surface) {
    surface_ = surface;
    fitted_ = false;
  }
  /// Copies the corners of the motion that was taken last, once.
  void fit(ThreadTeam& team);

  [[nodiscard]] const Tiling& tiling() const { return tiling_; }
  [[nodiscard]] const TileCorners& tile(int number) const { return corners_[number]; }
  [[nodiscard]] CellCorners cell(int number) const;

 private:
  void fit_tile(int number);
  /// Cells that lie in no chart are near nothing.
  void hide_missing(int number, int rows, int cols);

  const SurfaceGrid* grid_;
  Tiling tiling_;
  std::vector<TileCorners> corners_;
  MovingSurface surface_;
  bool fitted_ = false;
};

}  // namespace weft
