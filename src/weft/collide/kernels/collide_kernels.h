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

/// A block of samples, at least four columns, `stride` apart from row to row.
struct SampleBlock {
  const float *x, *y, *z;
  long stride;
  int rows, cols;
};
/// Least and largest. [m]
struct Extent {
  float min, max;
};

/// Kernels of the broad phase. Extents have twelve planes: of edges along rows least x, y, z and
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
  /// The same for the pairs of two nodes' children (1 << (4 i + k) for i of a, k of b).
  unsigned (*near_pairs)(const ChildPathBoxes& a, const ChildPathBoxes& b, float reach);
  /// Extent of samples along a direction, relative to an origin (three coordinates each).
  Extent (*along)(const SampleBlock& samples, const float* origin, const float* direction);
};

/// The kernels of an instruction set; the processor must have it to run them.
const CollideKernels& collide_kernels_for(InstructionSet set);

}  // namespace weft
