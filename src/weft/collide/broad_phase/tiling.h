#pragma once

#include <bit>

#include "weft/collide/broad_phase/candidate_pairs.h"
#include "weft/collide/broad_phase/patch_versions.h"

namespace weft {

/// The tiles of 2 x 4 cells of a surface, numbered row by row, and its patches, nodes of 4 x 4
/// cells that hold two tiles.
class Tiling {
 public:
  static constexpr int rows = 2, cols = 4, patch_side = PatchVersions::side;
  Tiling() = default;
  /// @param cells  a side
  explicit Tiling(int cells)
      : cells_(cells),
        tile_rows_((cells + rows - 1) / rows),
        patches_((cells + patch_side - 1) / patch_side) {}
  [[nodiscard]] int cells() const { return cells_; }                 ///< a side
  [[nodiscard]] int count() const { return tile_rows_ * patches_; }  ///< of tiles
  [[nodiscard]] int patches() const { return patches_; }             ///< a side
  /// Numbers of a cell, of the tile and the patch that it is in, and its place in the tile.
  [[nodiscard]] int cell_at(int row, int col) const { return row * cells_ + col; }
  [[nodiscard]] int tile_at(int row, int col) const { return row / rows * patches_ + col / cols; }
  [[nodiscard]] int patch_at(int row, int col) const {
    return row / patch_side * patches_ + col / patch_side;
  }
  static int lane_at(int row, int col) { return row % rows * cols + col % cols; }
  /// Row and column of a tile's first cell.
  [[nodiscard]] int first_row(int tile) const { return tile / patches_ * rows; }
  [[nodiscard]] int first_col(int tile) const { return tile % patches_ * cols; }
  /// The patches of a candidate's cell and tile, and its tile, if this is the tiling of their
  /// surface.
  [[nodiscard]] int patch_a(const CandidateTile& one) const {
    return patch_at(one.row_a, one.col_a);
  }
  [[nodiscard]] int patch_b(const CandidateTile& one) const {
    return patch_at(one.row_b, one.col_b);
  }
  [[nodiscard]] int tile_b(const CandidateTile& one) const { return tile_at(one.row_b, one.col_b); }
  /// Number of a cell of a candidate's tile.
  [[nodiscard]] int cell_b(const CandidateTile& one, int lane) const {
    return cell_at(one.row_b + lane / cols, one.col_b + lane % cols);
  }

 private:
  int cells_ = 0, tile_rows_ = 0, patches_ = 0;
};

/// Calls visit(lane) for the cells of a candidate's tile.
template <class Visit>
void for_lanes(unsigned cells, const Visit& visit) {
  for (; cells != 0; cells &= cells - 1) visit(std::countr_zero(cells));
}
/// Calls visit(pair) for the pairs of a candidate.
template <class Visit>
void for_pairs(const CandidateTile& found, const Tiling& of_a, const Tiling& of_b,
               const Visit& visit) {
  for_lanes(found.cells, [&](int lane) {
    visit(CandidatePair{of_a.cell_at(found.row_a, found.col_a), of_b.cell_b(found, lane)});
  });
}

/// Place of a node among those of its level in the order in which a pyramid is descended.
[[nodiscard]] unsigned place_in_order(int row, int col);

}  // namespace weft
