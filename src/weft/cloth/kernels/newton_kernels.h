#pragma once

#include <cstddef>

#include "weft/cloth/kernels/row_pointers.h"

// The inner loops of the method `newton`: rows of stencils with 3 x 3 blocks, and lines of block
// tridiagonal systems. As those of kernel_table.h: compiled once for every instruction set, the
// same bits in each. Rows come from planes with a frame of zeros (newton/padded_planes.h), so
// neighbours outside the image are read as zeros.

namespace weft {

enum class InstructionSet;

/// The springs of one direction that start from a row, and the states of both their ends: `there`
/// is shifted, so that column c is the other end of spring c.
struct LinearisedSprings {
  const float *rest_length, *stiffness, *damping;  ///< [m], [N/m], [N s/m]
  ConstRow3 here, there;                           ///< positions [m]
  ConstRow3 speed_here, speed_there;               ///< velocities [m/s]
  ConstRow3 start_here, start_there;               ///< positions when the step began [m]
  float per_step, step;                            ///< 1 / h, h [1/s], [s]
  float guessed_share;        ///< least transverse stiffness over the tension at the positions
  float limit, limit_factor;  ///< stiffer by this factor beyond limit * rest_length; 0: not
};

/// A spring's part of the Hessian, t 1 + s s^T, and its force factor f: force f (x_j - x_i).
struct SpringHessianRow {
  float *t, *x, *y, *z, *f;
};
struct ConstSpringHessianRow {
  const float *t, *x, *y, *z, *f;
};

/// A row of several planes: that of plane k begins at first + k * pitch.
struct PlaneRows {
  const float* first;
  std::ptrdiff_t pitch;
};
struct MutablePlaneRows {
  float* first;
  std::ptrdiff_t pitch;
};

/// Directions of springs to near neighbours, in the order of spring_offsets: to the right, down,
/// below right, below left.
inline constexpr int near_directions = 4;
/// Planes of near springs: rest length, stiffness and damping of each direction; t, x, y and z of
/// each direction's Hessian.
inline constexpr int spring_constants = 3, spring_entries = 4;
/// Planes of a symmetric 3 x 3 block: xx, xy, xz, yy, yz, zz.
inline constexpr int block_entries = 6;
/// Blocks of a nine-point stencil that start from a sample: its centre, and those to the neighbours
/// of near springs.
inline constexpr int stencil_blocks = 1 + near_directions;

/// Three rows of a field around one, with their frame.
struct RowTriple {
  ConstRow3 above, here, below;
};
/// A row of a field and the one below.
struct RowPair {
  ConstRow3 here, below;
};

/// The near springs that start from a row, with the states of the row and of the one below.
struct NearSprings {
  PlaneRows constants;             ///< [near_directions x spring_constants]
  RowPair position, speed, start;  ///< as in LinearisedSprings
  float per_step, step, guessed_share, limit, limit_factor;
};

/// Forces that a row passes to the one below while rows are computed one after another. [N]
struct Passing {
  ConstRow3 carried;  ///< from the row above
  Row3 carry;         ///< to the row below
};

/// Inertia, which holds the velocity v against v0 + h g.
struct InertiaRow {
  const float* mass;       ///< over h [kg/s]
  ConstRow3 speed, start;  ///< v, v0 [m/s]
  float gained[3];         ///< h g [m/s]
};

/// The start of a step, of `count` columns.
struct StepStartRow {
  int count;
  float time_step;               ///< [s]
  ConstRow3 position, velocity;  ///< [m], [m/s]
  ConstRow3 velocity_before;     ///< at the start of the last step; null: there is none
  ConstRow3 known;               ///< positions to compare with
};
struct StepGuessRow {
  Row3 start, start_velocity;  ///< what it starts from
  Row3 position, velocity;     ///< extrapolated
  Row3 gained;                 ///< the velocity change of the last step
};

/// A product with a symmetric matrix whose rows are computed one after another.
struct ProductRow {
  ConstRow3 here, below;  ///< the row of the factor and the one below
  Passing passing;
  ConstRow3 rhs;  ///< the product is subtracted from this; null: the product itself
};

/// Weights of bending's second differences: right, left, below, above, then diagonals as
/// bending_offsets.
struct BendingRows {
  PlaneRows above, here, below;
  int neighbours;  ///< 4 or 8
};

/// Diagonal blocks of a row: whole, without the springs along rows, without those down columns.
struct LineDiagonals {
  MutablePlaneRows whole, rows, cols;  ///< rows and cols null: whole alone
};

/// Planes that lines are read from: element (r, c) at base + r * stride + c.
struct PlaneView {
  const float* base;
  std::ptrdiff_t stride;
};
struct MutablePlaneView {
  float* base;
  std::ptrdiff_t stride;
};

/// A block of neighbouring lines of an n x n grid: along rows, line = row, or down columns, line =
/// column; `width` of at most line_lanes.
inline constexpr int line_lanes = 32;
struct LineBlock {
  bool along_rows;
  int first, width, length;
};
/// The matrix of a block of lines: diagonal blocks + extra * 1, and the coupling blocks between
/// positions p and p + 1.
struct LineMatrix {
  PlaneView diagonal[6], extra, coupling[6];
};
/// The matrix of a block of lines by its springs t 1 + s s^T to the next position, as t, x, y, z,
/// and the rest of the diagonal blocks: positive definite, without the line's own springs.
struct HeldLineMatrix {
  PlaneView held[6], spring[4];
};
/// Floats that the factor of a block of lines takes for each position: inverse and coupling blocks,
/// or inverse blocks and springs.
inline constexpr int line_factor_entries = 12, held_factor_entries = 10;

/// out = (add ? out : 0) + scale * solution, of a block of lines.
struct LineSolve {
  const float* factor;
  const PlaneView* rhs;  ///< x, y, z
  float scale;
  bool add;
  float* scratch;  ///< [length x 3 x line_lanes]
  const MutablePlaneView* out;
};

/// A guess of a step, of `count` columns.
struct GuessRow {
  int count;
  float time_step;            ///< [s]
  ConstRow3 start, velocity;  ///< of the step [m], [m/s]
  ConstRow3 position;         ///< guessed [m]
};

struct NewtonKernels {
  /// Of second neighbours, which come last.
  void (*linearise_far)(int n, const LinearisedSprings& springs, SpringHessianRow out);
  /// The energy of springs plus half of what damping dissipates in a step, if `step` is not 0 [J].
  double (*far_energy)(int n, const LinearisedSprings& springs);

  /// Copies the start of a step and extrapolates it.
  /// @return whether the positions are those known
  bool (*begin_step)(const StepStartRow& start, const StepGuessRow& out);
  /// Copies a guess. Where it is not start + h velocity, its velocity becomes the displacement over
  /// h.
  void (*follow_guess)(const GuessRow& guess, Row3 position, Row3 velocity);
  /// The Hessian of near springs, and the forces of springs and inertia,
  /// sum of f (x_j - x_i) - mass (v - v0 - h g) / h, row after row.
  void (*linearise)(int n, const NearSprings& springs, const InertiaRow& inertia,
                    MutablePlaneRows hessian, const Passing& passing, Row3 force);
  double (*near_energy)(int n, const NearSprings& springs);
  /// The diagonal blocks of mass / h^2 and near springs, and those without the line's own springs.
  /// @param springs, above  Hessians of those that start from the row and from the one above
  /// @param extra  added to the blocks without a line's springs
  void (*line_diagonals)(int n, PlaneRows springs, PlaneRows above, const float* mass,
                         const float* extra, const LineDiagonals& out);
  /// (mass / h^2 + near springs) x.
  void (*apply_springs)(int n, PlaneRows springs, const float* mass, const ProductRow& row,
                        Row3 out);
  /// A nine-point stencil times x.
  void (*apply_stencil)(int n, PlaneRows stencil, const ProductRow& row, Row3 out);
  /// out += factor B x.
  void (*add_blocks)(int n, PlaneRows blocks, float factor, ConstRow3 x, Row3 out);
  /// u = sum of weight (x_j - x_i).
  void (*bend)(int n, PlaneRows weights, int neighbours, const RowTriple& x, Row3 u);
  /// out += factor times the transpose of bend.
  void (*unbend)(int n, const BendingRows& weights, const RowTriple& u, float factor, Row3 out);

  /// The Galerkin product along rows: every second column of a fine row. Reads one column beyond
  /// either end. @param m  coarse columns
  void (*coarsen_columns)(int m, PlaneRows fine, MutablePlaneRows half);
  /// The same of near springs. @param centre  diagonal blocks
  /// @param mask, mask_below  1 where a sample moves, of the row and the one below
  void (*coarsen_springs)(int m, PlaneRows centre, PlaneRows springs, const float* mask,
                          const float* mask_below, MutablePlaneRows half);
  /// The Galerkin product across rows: a coarse row from the half-coarsened rows 2 q - 1, 2 q, 2 q
  /// + 1.
  void (*coarsen_rows)(int m, const PlaneRows* half, MutablePlaneRows coarse);

  /// Factors a block of lines. @param factor  [length x line_factor_entries x line_lanes]
  void (*factor_lines)(const LineBlock& lines, const LineMatrix& matrix, float* factor);
  /// @param factor  [length x held_factor_entries x line_lanes]
  void (*factor_held_lines)(const LineBlock& lines, const HeldLineMatrix& matrix, float* factor);
  void (*solve_lines)(const LineBlock& lines, const LineSolve& solve);
  void (*solve_held_lines)(const LineBlock& lines, const LineSolve& solve);

  /// A coarse row of m columns: the transpose of bilinear interpolation.
  void (*restrict_row)(int m, const RowTriple& fine, Row3 coarse);
  /// fine += interpolated mean of two coarse rows. @param n  fine columns
  void (*prolong_row)(int n, ConstRow3 a, ConstRow3 b, Row3 fine);

  /// out *= factor.
  void (*scale_rows)(int n, float factor, Row3 out);
  /// out += factor a.
  void (*add_scaled)(int n, float factor, ConstRow3 a, Row3 out);
  /// Sum of share a . b; share null: 1.
  double (*dot)(int n, const float* share, ConstRow3 a, ConstRow3 b);
  /// direction = z + factor direction. @return the sum of share residual . direction
  double (*update)(int n, const float* share, ConstRow3 z, float factor, ConstRow3 residual,
                   Row3 direction);
  /// step += length direction, residual -= length product. @return the largest |direction|^2
  float (*advance)(int n, float length, ConstRow3 direction, ConstRow3 product, Row3 step,
                   Row3 residual);
};

/// The kernels of an instruction set; the processor must have it to run them.
const NewtonKernels& newton_kernels_for(InstructionSet set);

}  // namespace weft
