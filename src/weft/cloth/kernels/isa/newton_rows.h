#pragma once

#include "weft/cloth/kernels/newton_kernels.h"

// The kernels of one instruction set, whose name WEFT_KERNEL_SET is.
namespace weft::WEFT_KERNEL_SET {

void linearise(int n, const LinearisedSprings& springs, SpringHessianRow out);
void gradient(int n, const SpringRing& ring, const RowTriple& x, const float* mass, ConstRow3 speed,
              ConstRow3 wanted, Row3 out);
void diagonal(int n, const SpringRing& ring, const float* mass, MutableBlockRow6 out);
void line_diagonals(int n, const SpringRing& ring, const float* mass, const float* extra,
                    const LineDiagonals& out);
void apply_springs(int n, const ConstSpringHessianRow* springs, const SpringSweep& at, Row3 out);
double spring_energy(int n, const LinearisedSprings& springs);
void bend(int n, const BendingRows& rows, const RowTriple& x, Row3 u);
void unbend(int n, const BendingRows& own, const BendingRows& back, const RowTriple& u, Row3 out);
void apply_block_stencil(int n, const BlockStencilRow& row, const RowTriple& x, Row3 out);
void add_block_row(int n, const BlockRow6& blocks, ConstRow3 x, Row3 out);
void spring_blocks(int n, ConstSpringHessianRow spring, const float* mask, const float* other,
                   MutableBlockRow6 out);
void coarsen_columns(int m, const StencilBlocks& fine, const MutableStencilBlocks& half);
void coarsen_rows(int m, const StencilBlocks* half, const MutableStencilBlocks& coarse);
void factor_lines(const LineBlock& lines, const LineMatrix& matrix, float* factor);
void factor_spring_lines(const LineBlock& lines, const SpringLineMatrix& matrix, float* factor);
void factor_held_lines(const LineBlock& lines, const HeldLineMatrix& matrix, float* factor);
void solve_lines(const LineBlock& lines, const float* factor, const PlaneView* rhs, float scale,
                 bool add, float* scratch, const MutablePlaneView* out);
void solve_held_lines(const LineBlock& lines, const float* factor, const PlaneView* rhs,
                      float scale, bool add, float* scratch, const MutablePlaneView* out);
void restrict_row(int n, int m, const RowTriple& fine, float* line, Row3 coarse);
void prolong_row(int n, ConstRow3 a, ConstRow3 b, float* line, Row3 fine);
void subtract(int n, ConstRow3 a, ConstRow3 b, Row3 out);
void scale_add(int n, ConstRow3 a, float factor, Row3 out);
void scale_row(int n, float factor, Row3 out);
void add_scaled(int n, float factor, ConstRow3 a, Row3 out);
double newton_dot(int n, const float* share, ConstRow3 a, ConstRow3 b);
float largest(int n, ConstRow3 a);

extern const NewtonKernels newton;

}  // namespace weft::WEFT_KERNEL_SET
