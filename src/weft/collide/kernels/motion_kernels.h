#pragma once

// The inner loops of the motion of bodies, compiled once for every instruction set: the same bits
// in each. They use nothing that a linker could take from another set's objects.

namespace weft {

enum class InstructionSet;

/// The samples of a row of cells: those of its two rows, x, y, z [m]; and of each cell 1 where its
/// diagonal rises, and 1 where it lies in a chart, else 0.
struct CellRow {
  const float *first[3], *second[3];
  const float *rising, *there;
};
/// Area vectors of the two triangles of each cell of a row, twice the area along the normal: x, y,
/// z and length. [m^2]
struct CellAreas {
  float *first[4], *second[4];
};
/// The same of the rows of cells before and behind a row of samples, each with a cell of no area
/// before its first one and behind its last one.
struct AreasAround {
  const float *first[2][4], *second[2][4], *rising[2];
};

/// A block of samples in a step, `stride` apart from row to row, with the unit normals of its
/// points at both ends.
struct MotionBlock {
  int rows, cols;
  long stride;
  const float *start[3], *end[3];  ///< [m]
  long normal_stride;
  const float *from[3], *to[3], *slant;  ///< see SurfaceMotion
};
/// What the columns of a block tell of its motion.
struct MotionColumns {
  float *lower[3], *upper[3];  ///< of the way [m]
  float* displacement[3];      ///< sum [m]
  float* normal[3];            ///< sum of the means of both ends
  float *slant, *turn;         ///< largest
  float *approach, *moved;     ///< largest [m]
};

/// Boxes side by side, in sixteens. [m]
struct BoxRows {
  const float *lower[3], *upper[3];
  int count;
};

struct MotionKernels {
  void (*cell_areas)(int cells, const CellRow& row, const CellAreas& out);
  /// Sums the areas of the triangles around n samples: x, y, z, and the sum of lengths.
  void (*sum_areas)(int n, const AreasAround& around, float* const* out);
  /// Turns n sums into unit normals, 0 where there is no area, and slants: see SurfaceMotion.
  void (*find_normals)(int n, float* const* sums);
  void (*gather_columns)(const MotionBlock& block, const MotionColumns& out);
  /// The most that the samples of each column approach a point that moves by `along`, and the most
  /// that their normals are apart from a mean.
  void (*part_columns)(const MotionBlock& block, const float* const* along,
                       const float* const* mean, float* approach, float* apart);
  /// The boxes that overlap one that is widened by `reach`. @return how many
  int (*find_overlaps)(const BoxRows& boxes, const float* lower, const float* upper, float reach,
                       int* found);
};

/// The kernels of an instruction set; the processor must have it to run them.
const MotionKernels& motion_kernels_for(InstructionSet set);

}  // namespace weft
