#pragma once

#include <cstddef>

#include "weft/cloth/kernels/row_pointers.h"

// Inner loops that are compiled once for every instruction set (kernels/isa/): each works on one
// row of n samples, reads its neighbours' rows and writes only to its outputs. They give the same
// bits in each set: no sum's order depends on the vector's width. This table has those of
// multigrid, bending, the strain limiter and the check for diverging cloth; those of implicit and
// explicit are in implicit_kernels.h, those of desbrun and two_level in filtering_kernels.h, those
// of newton in newton_kernels.h. What is outside these tables, such as contacts, wind, mates and
// the normals of curved cloth, is compiled once.

namespace weft {

enum class InstructionSet;

/// The springs that start from the samples of a row; as in SpringPlane.
struct SpringRow {
  const float *rest_length, *stiffness;
  const float* damping;  ///< null: none
};

/// Positions of a row now and at the start of the step.
struct MovingRow {
  ConstRow3 position, start;  ///< [m]
};

/// A row of the operator A of a filter level, with the edges that lead up from it. Above the first
/// row these are zeros.
struct OperatorRow {
  const float* weight;         ///< own part of M / h^2 + held [N/m]
  const float* right;          ///< edges to the right
  const float *below, *above;  ///< edges down from this row and from the one above
  const float *below_right, *above_left;
  const float *below_left, *above_right;
};

/// Three rows of a field around one of them; beyond the border any row of finite values.
struct StencilRows {
  ConstRow3 above, here, below;
};

/// A symmetric 3 x 3 block for every sample of a row.
struct BlockRow {
  const float *xx, *xy, *xz, *yy, *yz, *zz;
};
/// A sweep over a row under contacts: with blocks in place of a diagonal.
struct BlockSweepRow {
  float factor;
  BlockRow inverse;
  const float* count;  ///< as of SweepRow
  ConstRow3 rhs, value;
};

/// The columns first .. last - 1 of a row that have a neighbour `shift` columns to the right in
/// another row, and the weights that the two give each other.
struct TransposedRow {
  int first, last, shift;
  float factor;
  const float *own, *theirs;
  ConstRow3 here, there;
};

/// Springs from columns first .. last - 1 of a row to the columns `shift` further of the same or
/// another.
struct SpringRun {
  int first, last, shift;
  float per_step;  ///< [1/s]
  SpringRow springs;
  MovingRow here, there;
};

/// The columns first .. last - 1 of a row, their neighbours `shift` columns to the right in another
/// row, and the weights of the differences.
struct DifferenceRow {
  int first, last, shift;
  const float* weight;
  ConstRow3 here, there;
};

/// z += step_length d; then d = w + beta d; then x = y + z + d.
struct DirectionRow {
  float step_length, beta;
  ConstRow3 fall, correction;  ///< y, w [m]
  Row3 move, direction;        ///< z, d [m]
  Row3 position;               ///< x [m]
};

/// The position x = y + z + step_length d at the end of a step, and its velocity
/// v + gained + (z + step_length d) per_step.
struct PlacedRow {
  float step_length, per_step;
  float gained[3];  ///< by gravity [m/s]
  ConstRow3 fall, move, direction, start_velocity;
  Row3 position, velocity;
};

/// The inputs of a smoothing sweep over a row, besides -A x.
struct SweepRow {
  float factor;
  const float* inverse;        ///< of the diagonal; 0 where nothing moves
  const float *share, *count;  ///< of mates: one over their number, their number; null: 1
  ConstRow3 rhs, value;
};

/// Springs that share no particle: from column c of `here` to column c + shift of `there` for c =
/// first, first + step, ... below last.
struct LimitedRows {
  Row3 here, there, here_velocity, there_velocity;
  const float *here_inverse_mass, *there_inverse_mass, *rest_length;
  int shift, first, last, step;
  float shortest, longest, inverse_step;  ///< as StrainBounds
  float relaxation;                       ///< of the corrections
};

/// Kinetic energy and largest speed of a row.
struct RowMotion {
  double kinetic;         ///< [J]
  float largest_squared;  ///< speed [m^2/s^2]
  bool finite;            ///< all positions and velocities
};

/// Cholesky's factor L of `count` unknowns within its envelope, below the diagonal: by rows, each
/// run ending before the diagonal, and by columns, each beginning after it. Runs are padded with
/// zeros, away from the diagonal, to a multiple of `envelope_padding`.
struct Envelope {
  int count;
  const float* inverse_diagonal;
  const float *rows, *columns;
  const std::ptrdiff_t *row_start, *column_start;  ///< [count + 1]
};
inline constexpr int envelope_padding = 16;

/// Scratch `lines` are three rows of n values that are overwritten.
struct KernelTable {
  /// Adds the forces of springs to both ends [N]; `out` and `out_there` may be one row.
  void (*springs)(const SpringRun& run, Row3 lines, Row3 out, Row3 out_there);
  /// @return their energy, sum of k/2 (length - rest)^2 [J]
  double (*spring_energy)(const SpringRun& run);
  /// out += weight (there - here).
  void (*add_differences)(const DifferenceRow& row, Row3 out);
  /// The transpose: out += factor (own u - theirs u there), both weights those of one pair.
  void (*add_transposed)(const TransposedRow& row, Row3 out);
  /// force -= weight (z + d). @return its dot product with d [N m]
  double (*inertia)(int n, const float* weight, ConstRow3 move, ConstRow3 direction, Row3 force);
  /// @return the largest |d|^2 [m^2]
  float (*update_direction)(int n, const DirectionRow& row);
  void (*place)(int n, const PlacedRow& row);
  /// residual += step_length (far - residual).
  void (*step_residual)(int n, float step_length, ConstRow3 far, Row3 residual);

  /// The sum of share a . b; share null: 1.
  double (*dot)(int n, const float* share, ConstRow3 a, ConstRow3 b);

  /// out = factor inverse rhs: a sweep from zero.
  void (*first_sweep)(int n, float factor, const float* inverse, ConstRow3 rhs, Row3 out);
  /// out = -A x, own part.
  void (*apply)(int n, const OperatorRow& row, const StencilRows& x, Row3 out);
  /// out = out + share rhs where the particle moves, else 0. @param share  null: 1
  void (*add_rhs)(int n, const float* share, const float* inverse, ConstRow3 rhs, Row3 out);
  /// out = value + factor inverse (rhs + count out). @return share rhs . out
  double (*sweep)(int n, const SweepRow& row, Row3 out);
  /// out -= B x.
  void (*subtract_blocks)(int n, const BlockRow& blocks, ConstRow3 x, Row3 out);
  /// out = factor B x.
  void (*apply_blocks)(int n, float factor, const BlockRow& blocks, ConstRow3 x, Row3 out);
  /// out = value + factor inverse (rhs + count out).
  void (*block_sweep)(int n, const BlockSweepRow& row, Row3 out);
  /// The transpose of interpolation: a coarse row of three fine ones of n samples.
  void (*restrict_rows)(int n, const StencilRows& fine, Row3 lines, Row3 out);
  /// out += the mean of two coarse rows, interpolated to n samples, where the particle moves.
  void (*interpolate)(int n, ConstRow3 a, ConstRow3 b, const float* inverse, Row3 lines, Row3 out);

  /// x = (L L^T)^-1 x for all three coordinates at once; x has room for a padding before and after.
  void (*substitute)(const Envelope& factor, Row3 x);

  /// Whether any of the springs is out of its bounds.
  bool (*breaks_limit)(const LimitedRows& rows);
  /// Moves both ends of the springs out of bounds, by inverse mass.
  void (*limit)(const LimitedRows& rows);

  RowMotion (*motion)(int n, const float* mass, ConstRow3 position, ConstRow3 velocity);
};

/// The kernels of an instruction set; the processor must have it to run them.
const KernelTable& kernels_for(InstructionSet set);

}  // namespace weft
