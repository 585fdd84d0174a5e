#pragma once

// The inner loops of the broad phase, compiled once for every instruction set: the same bits in
// each. They use nothing that a linker could take from another set's objects.

namespace weft {

enum class InstructionSet;

/// One coordinate of a row of cells: samples of its two rows, at the start and at the end.
struct EdgeRows {
  const float *start, *next_start, *end, *next_end;
};

/// Where a node of a surface is at both ends of a step, axis by axis; every sample goes straight,
/// so in between it is in the box that moves from the one to the other. [m]
struct PathBox {
  float lower_start[3], upper_start[3], lower_end[3], upper_end[3];
};
/// Those of a node's four children side by side; what is missing is near nothing.
struct alignas(64) ChildPathBoxes {
  float lower_start[3][4], upper_start[3][4], lower_end[3][4], upper_end[3][4];
};

/// A block of samples, at least four columns, `stride` apart from row to row.
struct SampleBlock {
  const float *x, *y, *z;
  long stride;
  int rows, cols;
};
/// Least and largest. [m]
struct Extent {
  float least, largest;
};

/// Extents have twelve planes: of edges along rows least x, y, z and largest x, y, z, then the same
/// of edges along columns. A row of them is twelve pointers.
struct CollideKernels {
  /// Extents of one coordinate of the edges of n cells: least and largest along rows, then along
  /// columns.
  void (*edges)(int n, const EdgeRows& rows, float* const* out);
  /// Joins n windows of 2 x 2 of two rows of n + 1.
  void (*join_windows)(int n, const float* const* a, const float* const* b, float* const* out);
  /// Joins 2 x 2 into n of the next level.
  void (*join_twos)(int n, const float* const* a, const float* const* b, float* const* out);
  /// Judges n rectangles for their extents: 1 where they are certainly unfolded, see
  /// UnfoldedWindows, else 0.
  void (*find_unfolded)(int n, const float* const* extents, float slack, float* out);

  /// Which of a node's children (1 << k) may come within `reach` of another: those that are not
  /// beyond it along some axis at both ends of the step in the same order. What moves along with
  /// each other is not swept together. Positions that are not numbers are near nothing.
  unsigned (*near_children)(const PathBox& node, const ChildPathBoxes& children, float reach);
  /// The same of the pairs of two nodes' children (1 << (4 i + k) for i of a, k of b).
  unsigned (*near_pairs)(const ChildPathBoxes& a, const ChildPathBoxes& b, float reach);
  /// How far samples lie along a direction, seen from an origin (three coordinates each).
  Extent (*along)(const SampleBlock& samples, const float* origin, const float* direction);
};

/// The kernels of an instruction set; the processor must have it to run them.
const CollideKernels& collide_kernels_for(InstructionSet set);

}  // namespace weft
