#pragma once

// The inner loops of the broad phase, compiled once for every instruction set: the same bits in
// each. They use nothing that a linker could take from another set's objects.

namespace weft {

enum class InstructionSet;

/// One coordinate of a row of cells: samples of its two rows, at the start and at the end.
struct EdgeRows {
  const float *start, *next_start, *end, *next_end;
};

/// Boxes of a surface's node at both ends of a step, axis by axis. Every sample moves on a straight
/// line, so in between the node is in the interpolated box. [m]
struct PathBox {
  float lower_start[3], upper_start[3], lower_end[3], upper_end[3];
};
/// Path boxes of a node's four children side by side; a missing child is near nothing.
struct alignas(64) ChildPathBoxes {
  float lower_start[3][4], upper_start[3][4], lower_end[3][4], upper_end[3][4];
};

/// Number of cells in a tile, 2 x 4, numbered row by row; and in a patch, 4 x 4.
inline constexpr int tile_cells = 8, patch_cells = 16;

/// Path boxes of a tile's cells, axis by axis; NaN where the surface has no cell. [m]
struct alignas(64) TileBoxes {
  float lower_start[3][tile_cells], upper_start[3][tile_cells];
  float lower_end[3][tile_cells], upper_end[3][tile_cells];
};

/// Path boxes of a patch's cells, row by row; NaN where the surface has no cell.
struct PatchBoxes {
  PathBox cells[patch_cells];
};

/// The four corners of a tile's cells at both ends of a step, axis by axis and corner by corner;
/// NaN where the surface has no cell. [m]
struct alignas(64) TileCorners {
  float start[3][4][tile_cells], end[3][4][tile_cells];
  int falling[tile_cells];  ///< 1 where a cell's diagonal joins its corners 1 and 2, else 0
};
/// The same of one cell.
struct CellCorners {
  float start[3][4], end[3][4];
  int falling;
};

/// Kernels of collision. Extents have twelve planes: of edges along rows least x, y, z and
/// largest x, y, z, then the same of edges along columns. A row of them is twelve pointers.
struct CollideKernels {
  /// Extents of one coordinate of the edges of n cells: least and largest along rows, then along
  /// columns.
  void (*edges)(int n, const EdgeRows& rows, float* const* out);
  /// Joins the extents of two rows of n + 1 nodes into n windows of 2 x 2.
  void (*join_windows)(int n, const float* const* a, const float* const* b, float* const* out);
  /// Joins blocks of 2 x 2 nodes into n nodes of the next coarser level.
  void (*join_twos)(int n, const float* const* a, const float* const* b, float* const* out);
  /// Tests n rectangles by their extents: 1 where they are certainly unfolded, see UnfoldedWindows,
  /// else 0.
  void (*find_unfolded)(int n, const float* const* extents, float slack, float* out);

  /// Mask (1 << k) of the children that may come within `reach` of a node: those that no axis
  /// separates in the same order at both ends of the step. Common motion does not widen the boxes,
  /// as nothing is swept. Boxes that are NaN on all axes are near nothing.
  unsigned (*near_children)(const PathBox& node, const ChildPathBoxes& children, float reach);
  /// For each cell of a patch, mask (1 << k) of a tile's cells that may come within `reach` of it,
  /// as near_children.
  void (*near_cells)(const PatchBoxes& patch, const TileBoxes& tile, float reach, unsigned* out);
  /// For each of a tile's cells: by how much it certainly keeps farther from a cell than `at_start`
  /// at the start and `at_end` at the end of the step, in the same order along one direction, as
  /// the smaller of both; the largest over the direction between the cells and both normals. Where
  /// it is positive the cells never meet. NaN where the tile has no cell. [m]
  void (*tile_gaps)(const CellCorners& cell, const TileCorners& tile, float at_start, float at_end,
                    float* out);
  /// For each of a tile's cells, up to which distance at the start features of it and of a cell may
  /// come within `reach` during the step; and the same of edges, for which `flat_reach` counts
  /// where both cells are nearly parallel. [m]
  void (*tile_reaches)(const CellCorners& cell, const TileCorners& tile, float reach,
                       float flat_reach, float* near, float* near_edges);
  /// Which triangles of a tile's cells may have a cell's corner above or below them, within `near`
  /// [m] at the start and up to `beside` [m] beyond their edges, rounding allowed for: bits 0 and 1
  /// for both halves of each.
  void (*corner_over_tile)(const CellCorners& cell, int corner, const TileCorners& tile,
                           const float* near, float beside, int* out);
  /// The same of that corner of each of a tile's cells, and the two triangles of a cell.
  void (*tile_over_cell)(const CellCorners& cell, const TileCorners& tile, int corner,
                         const float* near, float beside, int* out);
  /// Which edges may have their closest points inside both, within `near` at the start, or are
  /// nearly parallel: bit 3 p + q for edges p of the cell and q of each of the tile's, from corner
  /// 0 to 1, from 0 to 2, and the diagonal.
  void (*tile_edges)(const CellCorners& cell, const TileCorners& tile, const float* near, int* out);
};

/// The kernels of an instruction set; the processor must have it to run them.
const CollideKernels& collide_kernels_for(InstructionSet set);

}  // namespace weft
