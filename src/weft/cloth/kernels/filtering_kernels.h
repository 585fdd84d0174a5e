#pragma once

#include <cstddef>

#include "weft/cloth/kernels/row_pointers.h"

// The inner loops of the methods that filter accelerations, desbrun and two_level. As those of
// kernel_table.h: compiled once for every instruction set, the same bits in each.

namespace weft {

enum class InstructionSet;

/// The springs between the particles of a row and one of their neighbours. All pointers but those
/// of `position` and `velocity` are shifted so that column c belongs to particle c.
struct ViscousRow {
  const float *rest_length, *stiffness, *viscosity;
  ConstRow3 position, velocity, other_position, other_velocity;
  int first, last;
};

/// Accelerations of the particles of a row: a + linear + (x - centre) x turn.
struct AcceleratedRow {
  float time_step;
  float linear[3], centre[3], turn[3];
  ConstRow3 position, velocity, acceleration;
};

/// Rows of a matrix of as many columns as the stride, a multiple of 16; padded with zeros.
struct DenseMatrix {
  const float* data;
  std::ptrdiff_t stride;
};

/// Weights of a row of samples under a patch. `centred`: for columns whose patch is centred, by the
/// distance from its middle, [rows x (half + 1)]. `beside`: for the first `half` columns, by
/// column, [rows x (2 half + 1) x lanes]; the last columns are their mirror image.
struct PatchWeights {
  int half, rows, lanes;
  const float *centred, *beside;
};

/// The inputs of a row's moments.
struct MomentRow {
  const float *mass, *owner;
  ConstRow3 position, acceleration;
  float about[3];
};
/// Mass; sums of m x; of m a; of x cross m a; of m x x^T: xx, yy, zz, xy, xz, yz.
inline constexpr int moment_terms = 16;

struct FilteringKernels {
  /// force += pull along the spring, and viscosity times the relative velocity [N].
  void (*viscous_springs)(const ViscousRow& row, Row3 force);
  /// row *= factor.
  void (*scale)(int n, const float* factor, Row3 row);
  /// Position and velocity at the end of a step.
  void (*accelerate)(int n, const AcceleratedRow& row, Row3 position, Row3 velocity);
  /// Adds the row's moments, each in lanes of its own.
  void (*moments)(int n, const MomentRow& row, double* sums);
  /// Rows first .. last - 1 of matrix times three vectors, each row read once.
  void (*dense_rows)(int first, int last, const DenseMatrix& matrix, ConstRow3 vectors, Row3 out);
  /// out = a + b, padding included.
  void (*add_rows)(int n, const float* a, const float* b, float* out);
  /// One row of a plane under a sliding patch. @param lines  [(half + 1) x n padded] scratch
  void (*patch_row)(int n, const float* const* rows, const PatchWeights& patch, float* lines,
                    float* out);
};

/// The kernels of an instruction set; the processor must have it to run them.
const FilteringKernels& filtering_kernels_for(InstructionSet set);

}  // namespace weft
