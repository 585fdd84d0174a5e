#pragma once

// The inner loops of contacts with bodies, compiled once for every instruction set: the same bits
// in each. They use nothing that a linker could take from another set's objects.

namespace weft {

enum class InstructionSet;

/// Boxes of the 4 x 4 children of a node side by side, row by row; those of a missing child are
/// upside down, and far from everything. [m]
struct alignas(64) BodyNode {
  float lower[3][16], upper[3][16];
};
/// The coordinate that stands for far away. Its square is a number yet. [m]
inline constexpr float far_away = 1e18F;

/// Which of the triangles of a leaf's 2 x 2 cells there are, and which cells are divided by their
/// rising diagonal. Bit 2 r + c is cell (r, c) of the leaf, its first triangle, and bit 4 + 2 r + c
/// its second one.
struct BodyLeaf {
  unsigned char there = 0, rising = 0;
};

/// A body's image as a tree: leaves of 2 x 2 cells, and above them nodes of 4 x 4 children each.
struct BodyTree {
  static constexpr int max_levels = 8;
  const float *x = nullptr, *y = nullptr, *z = nullptr;  ///< samples
  long stride = 0;                                       ///< of their rows
  int size = 0;                                          ///< n: samples a side, >= 3
  int leaf_side = 0, levels = 0;
  const BodyLeaf* leaves = nullptr;     ///< [leaf_side x leaf_side]
  const BodyNode* nodes[max_levels]{};  ///< of each level, the one of the root last
  int sides[max_levels]{};              ///< of each level
  /// The first row or column of a leaf's cells. The last leaf shares one with the leaf before it
  /// where there is an odd number of cells.
  int first_cell(int leaf) const { return 2 * leaf + 2 < size ? 2 * leaf : size - 3; }
};

/// What is near a point.
struct NearSearch {
  float at[3];
  float reach;     ///< nothing beyond is asked for [m]
  float rounding;  ///< of the point and of coordinates [m]
};

/// The triangles (2 * cell + half) found.
struct NearTriangles {
  static constexpr int capacity = 600;
  int found[capacity];
  int count;  ///< more than the capacity: there were too many
};

/// Points that are looked at together, as they lie next to each other.
struct NearTile {
  static constexpr int capacity = 64;
  float at[3][capacity];
  float reach[capacity];  ///< as of NearSearch
  bool exact[capacity];   ///< whether the reach is the distance of a triangle
  int count;
  float rounding;  ///< as of NearSearch
  float beyond;    ///< how much farther triangles are told from the closest one [m]
};

/// A triangle that may be closest to one of the points.
struct TileTriangle {
  int point, triangle;
};
struct TileTriangles {
  static constexpr int capacity = 1024;
  TileTriangle found[capacity];  ///< by points
  int count;                     ///< more than the capacity: there were too many
  /// Lower bounds of the distances of triangles that were not found, as far as `beyond`. [m]
  float others[NearTile::capacity];
};

/// A row of what is known of samples' distances to a body, see KnownDistances. [m]
struct KnownRow {
  const float *place[3], *travelled;
  float *seen[3], *distance;
};
/// A row of a cloth in a step, with the motion of what of the body is near. [m]
struct ReachRow {
  const float *start[3], *end[3];
  const float *carried[3], *travelled;  ///< before the step
  const float *along[3], *approach;     ///< in the step
  float margin, farthest, max_approach;
};

struct BodyKernels {
  /// Finds the triangles that may be closest to a point: the closest is among them, if it is within
  /// reach.
  void (*find_near)(const BodyTree& tree, const NearSearch& search, NearTriangles& out);
  /// The same for all points of a tile.
  void (*find_near_tile)(const BodyTree& tree, const NearTile& tile, TileTriangles& out);
  /// How far n samples have to look for the body, or 0 where they are known to be farther from it;
  /// notes that they were seen, and forgets what went too far. [m]
  void (*reach_row)(int n, const KnownRow& known, const ReachRow& row, float* reach);
  /// Extents of the samples of a row of leaves, of one coordinate of their three rows.
  /// @param last  index of the last sample of a row
  void (*leaf_extents)(int leaves, int last, const float* const* rows, float* lower, float* upper);
};

/// The kernels of an instruction set; the processor must have it to run them.
const BodyKernels& body_kernels_for(InstructionSet set);

}  // namespace weft
