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

/// The eight springs around the particles of a row: right, left, below, above, below right, above
/// left, below left, above right, each shifted so that column c is the spring of particle c.
inline constexpr int ring_size = 8;
struct SpringRing {
  ConstSpringHessianRow spring[ring_size];
};

/// Three rows of a field around one, with their frame.
struct RowTriple {
  ConstRow3 above, here, below;
};

/// A row of a field and the one below, and the spring forces passed from row to row. [N]
struct SpringSweep {
  ConstRow3 here, below;
  const float* mass;                    ///< over h^2 [N/m]
  ConstRow3 carried;                    ///< forces of the row above's springs on this row
  Row3 carry;                           ///< forces of this row's springs on the row below
  Row3 right, below_right, below_left;  ///< scratch with a frame
};

/// Weights of bending's second difference for a row.
struct BendingRows {
  const float* weight[ring_size];  ///< right, left, below, above, then diagonals as bending_offsets
  int neighbours;                  ///< 4 or 8
};

/// Rows of symmetric blocks.
struct BlockRow6 {
  const float* entry[6];
};
struct MutableBlockRow6 {
  float* entry[6];
};

/// Diagonal blocks of a row: whole, without the springs along rows, without those down columns.
struct LineDiagonals {
  MutableBlockRow6 whole, rows, cols;
};

/// A row of a nine-point stencil of blocks: centre, right, below left, below, below right, and
/// those that lead back: left, above right, above, above left, shifted to the particle.
struct BlockStencilRow {
  BlockRow6 centre, right, below_left, below, below_right, left, above_right, above, above_left;
};

/// The five rows of blocks that start from a row.
struct StencilBlocks {
  BlockRow6 centre, right, below_left, below, below_right;
};
struct MutableStencilBlocks {
  MutableBlockRow6 centre, right, below_left, below, below_right;
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
/// As LineMatrix, with the coupling -(t 1 + s s^T) of springs: t, x, y, z.
struct SpringLineMatrix {
  PlaneView diagonal[6], extra, coupling[4];
};
/// The matrix of a block of lines by its springs t 1 + s s^T to the next position, as t, x, y, z,
/// and the rest of the diagonal blocks: positive definite, without the line's own springs.
struct HeldLineMatrix {
  PlaneView held[6], spring[4];
};
/// Floats that the factor of a block of lines takes for each position: inverse and coupling blocks,
/// or inverse blocks and springs.
inline constexpr int line_factor_entries = 12, held_factor_entries = 10;

struct NewtonKernels {
  void (*linearise)(int n, const LinearisedSprings& springs, SpringHessianRow out);
  /// out = mass (v - w) / h - sum of f (x_j - x_i): the gradient of inertia and springs.
  /// @param mass  times 1 / h [kg/s]  @param speed  v  @param wanted  v0 + h g, w [m/s]
  void (*gradient)(int n, const SpringRing& ring, const RowTriple& x, const float* mass,
                   ConstRow3 speed, ConstRow3 wanted, Row3 out);
  /// The diagonal blocks of mass / h^2 and springs.
  void (*diagonal)(int n, const SpringRing& ring, const float* mass, MutableBlockRow6 out);
  /// The diagonal blocks, and those without the line's own springs, along rows and down columns.
  /// @param extra  added to the latter on the diagonal
  void (*line_diagonals)(int n, const SpringRing& ring, const float* mass, const float* extra,
                         const LineDiagonals& out);
  /// out = (mass / h^2 + springs) x, each spring evaluated once, row after row.
  /// @param springs  that start from the row: to the right, down, below right, below left
  void (*apply_springs)(int n, const ConstSpringHessianRow* springs, const SpringSweep& at,
                        Row3 out);
  /// The energy of springs plus half of what damping dissipates in a step, if `step` is not 0 [J].
  double (*spring_energy)(int n, const LinearisedSprings& springs);
  /// u = sum of weight (x_j - x_i).
  void (*bend)(int n, const BendingRows& rows, const RowTriple& x, Row3 u);
  /// out += sum of weight_back u_j - weight u_i, the transpose; `back` are the weights by which
  /// each neighbour sees this particle, shifted to it.
  void (*unbend)(int n, const BendingRows& own, const BendingRows& back, const RowTriple& u,
                 Row3 out);
  /// out = stencil x.
  void (*apply_blocks)(int n, const BlockStencilRow& row, const RowTriple& x, Row3 out);
  /// out += B x.
  void (*add_blocks)(int n, const BlockRow6& blocks, ConstRow3 x, Row3 out);
  /// -(t 1 + s s^T) times both masks. @param mask  of this end  @param other  of the other, shifted
  void (*spring_blocks)(int n, ConstSpringHessianRow spring, const float* mask, const float* other,
                        MutableBlockRow6 out);
  /// The Galerkin product along rows: every second column of a fine row of n. Reads one column
  /// beyond either end. @param m  coarse columns
  void (*coarsen_columns)(int m, const StencilBlocks& fine, const MutableStencilBlocks& half);
  /// The Galerkin product across rows: a coarse row from the half-coarsened rows 2 q - 1, 2 q, 2 q
  /// + 1.
  void (*coarsen_rows)(int m, const StencilBlocks* half, const MutableStencilBlocks& coarse);

  /// Factors a block of lines. @param factor  [length x line_factor_entries x line_lanes]
  void (*factor_lines)(const LineBlock& lines, const LineMatrix& matrix, float* factor);
  void (*factor_spring_lines)(const LineBlock& lines, const SpringLineMatrix& matrix,
                              float* factor);
  /// @param factor  [length x held_factor_entries x line_lanes]
  void (*factor_held_lines)(const LineBlock& lines, const HeldLineMatrix& matrix, float* factor);
  /// out = (add ? out : 0) + scale * solution. @param scratch  [length x 3 x line_lanes]
  void (*solve_lines)(const LineBlock& lines, const float* factor, const PlaneView* rhs,
                      float scale, bool add, float* scratch, const MutablePlaneView* out);
  void (*solve_held_lines)(const LineBlock& lines, const float* factor, const PlaneView* rhs,
                           float scale, bool add, float* scratch, const MutablePlaneView* out);

  /// A coarse row: the transpose of bilinear interpolation. @param line  [n + 3] scratch
  void (*restrict_row)(int n, int m, const RowTriple& fine, float* line, Row3 coarse);
  /// fine += interpolated mean of two coarse rows. @param line  [m + 1] scratch
  void (*prolong_row)(int n, ConstRow3 a, ConstRow3 b, float* line, Row3 fine);

  /// out = a - b.
  void (*subtract)(int n, ConstRow3 a, ConstRow3 b, Row3 out);
  /// out = a + factor out.
  void (*scale_add)(int n, ConstRow3 a, float factor, Row3 out);
  /// out *= factor.
  void (*scale_rows)(int n, float factor, Row3 out);
  /// out += factor a.
  void (*add_scaled)(int n, float factor, ConstRow3 a, Row3 out);
  /// Sum of share a . b; share null: 1.
  double (*dot)(int n, const float* share, ConstRow3 a, ConstRow3 b);
  /// The largest |a|^2.
  float (*largest)(int n, ConstRow3 a);
};

/// The kernels of an instruction set; the processor must have it to run them.
const NewtonKernels& newton_kernels_for(InstructionSet set);

}  // namespace weft
