#pragma once

#include "weft/cloth/kernels/implicit_kernels.h"

// The kernels of one instruction set, whose name WEFT_KERNEL_SET is.
namespace weft::WEFT_KERNEL_SET {

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

}  // namespace weft::WEFT_KERNEL_SET
