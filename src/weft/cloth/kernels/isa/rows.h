#pragma once

#include "weft/cloth/kernels/kernel_table.h"

// The kernels of one instruction set, whose name WEFT_KERNEL_SET is.
namespace weft::WEFT_KERNEL_SET {

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

}  // namespace weft::WEFT_KERNEL_SET
