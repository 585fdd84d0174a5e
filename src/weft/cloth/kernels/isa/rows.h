#pragma once

#include "weft/cloth/kernels/filtering_kernels.h"
#include "weft/cloth/kernels/implicit_kernels.h"
#include "weft/cloth/kernels/kernel_table.h"
#include "weft/cloth/kernels/newton_kernels.h"

// The kernels of one instruction set, whose name WEFT_KERNEL_SET is.
namespace weft::WEFT_KERNEL_SET {

// Of several methods.
void springs(const SpringRun& run, Row3 lines, Row3 out, Row3 out_there);
double spring_energy(const SpringRun& run);
void add_differences(const DifferenceRow& row, Row3 out);
void add_transposed(const TransposedRow& row, Row3 out);
double inertia(int n, const float* weight, ConstRow3 move, ConstRow3 direction, Row3 force);
float update_direction(int n, const DirectionRow& row);
void place(int n, const PlacedRow& row);
void step_residual(int n, float step_length, ConstRow3 far, Row3 residual);
double dot(int n, const float* share, ConstRow3 a, ConstRow3 b);
void first_sweep(int n, float factor, const float* inverse, ConstRow3 rhs, Row3 out);
void apply(int n, const OperatorRow& row, const StencilRows& x, Row3 out);
void add_rhs(int n, const float* share, const float* inverse, ConstRow3 rhs, Row3 out);
double sweep(int n, const SweepRow& row, Row3 out);
void subtract_blocks(int n, const BlockRow& blocks, ConstRow3 x, Row3 out);
void apply_blocks(int n, float factor, const BlockRow& blocks, ConstRow3 x, Row3 out);
void block_sweep(int n, const BlockSweepRow& row, Row3 out);
void restrict_rows(int n, const StencilRows& fine, Row3 lines, Row3 out);
void interpolate(int n, ConstRow3 a, ConstRow3 b, const float* inverse, Row3 lines, Row3 out);
void substitute(const Envelope& factor, Row3 x);
bool breaks_limit(const LimitedRows& rows);
void limit(const LimitedRows& rows);
RowMotion motion(int n, const float* mass, ConstRow3 position, ConstRow3 velocity);

extern const KernelTable table;

// Of methods that filter forces.
void viscous_springs(const ViscousRow& row, Row3 force);
void scale(int n, const float* factor, Row3 row);
void accelerate(int n, const AcceleratedRow& row, Row3 position, Row3 velocity);
void moments(int n, const MomentRow& row, double* sums);
void dense_rows(int first, int last, const DenseMatrix& matrix, ConstRow3 vectors, Row3 out);
void add_rows(int n, const float* a, const float* b, float* out);
void patch_row(int n, const float* const* rows, const PatchWeights& patch, float* lines,
               float* out);

extern const FilteringKernels filtering;

// Of implicit Euler by conjugate gradients.
void elastic(const NeighbourSprings& row, Row3 force);
void axial_damping(const NeighbourSprings& row, Row3 force);
void linearise(const NeighbourSprings& row, float time_step, float* transverse, Row3 axial);
void multiply(const NeighbourBlocks& row, Row3 out);
void add_blocks(const NeighbourBlocks& row, const BlockRowOut& out);
void add_mass(int n, const float* mass, ConstRow3 value, Row3 out);
void invert_blocks(int n, const InvertedRow& row, const BlockRowOut& out);
void multiply_blocks(int n, const BlockRow& blocks, Row3 value);
float gradient_step(int n, const GradientStepRow& row);
void update_direction(int n, float beta, ConstRow3 correction, Row3 direction);
void subtract(int n, ConstRow3 value, Row3 out);
void restrict_plane(int n, const WeighedRows& fine, float* line, float* out);
void fall(int n, const StartRow& start, Row3 velocity);
void right_side(int n, const StartRow& start, Row3 out);
void move(int n, const StartRow& start, ConstRow3 velocity, Row3 position);
void advance(int n, const StartRow& start, Row3 position, Row3 velocity);

extern const ImplicitKernels implicit;

// Of the default method.
void linearise_far(int n, const LinearisedSprings& springs, SpringHessianRow out);
double far_energy(int n, const LinearisedSprings& springs);
void linearise(int n, const NearSprings& springs, const InertiaRow& inertia,
               MutablePlaneRows hessian, const Passing& passing, Row3 force);
bool begin_step(const StepStartRow& start, const StepGuessRow& out);
void follow_guess(const GuessRow& guess, Row3 position, Row3 velocity);
double near_energy(int n, const NearSprings& springs);
void line_diagonals(int n, PlaneRows springs, PlaneRows above, const float* mass,
                    const float* extra, const LineDiagonals& out);
void apply_springs(int n, PlaneRows springs, const float* mass, const ProductRow& row, Row3 out);
void apply_stencil(int n, PlaneRows stencil, const ProductRow& row, Row3 out);
void add_block_row(int n, PlaneRows blocks, float factor, ConstRow3 x, Row3 out);
void bend(int n, PlaneRows weights, int neighbours, const RowTriple& x, Row3 u);
void unbend(int n, const BendingRows& weights, const RowTriple& u, float factor, Row3 out);
void coarsen_columns(int m, PlaneRows fine, MutablePlaneRows half);
void coarsen_springs(int m, PlaneRows centre, PlaneRows springs, const float* mask,
                     const float* mask_below, MutablePlaneRows half);
void coarsen_rows(int m, const PlaneRows* half, MutablePlaneRows coarse);
void factor_lines(const LineBlock& lines, const LineMatrix& matrix, float* factor);
void factor_held_lines(const LineBlock& lines, const HeldLineMatrix& matrix, float* factor);
void solve_lines(const LineBlock& lines, const LineSolve& solve);
void solve_held_lines(const LineBlock& lines, const LineSolve& solve);
void restrict_row(int m, const RowTriple& fine, Row3 coarse);
void prolong_row(int n, ConstRow3 a, ConstRow3 b, Row3 fine);
void scale_row(int n, float factor, Row3 out);
void add_scaled(int n, float factor, ConstRow3 a, Row3 out);
double newton_dot(int n, const float* share, ConstRow3 a, ConstRow3 b);
double update(int n, const float* share, ConstRow3 z, float factor, ConstRow3 residual,
              Row3 direction);
float advance(int n, float length, ConstRow3 direction, ConstRow3 product, Row3 step,
              Row3 residual);

extern const NewtonKernels newton;

}  // namespace weft::WEFT_KERNEL_SET
