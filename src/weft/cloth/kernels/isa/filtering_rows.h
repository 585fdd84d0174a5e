#pragma once

#include "weft/cloth/kernels/filtering_kernels.h"

// The kernels of one instruction set, whose name WEFT_KERNEL_SET is.
namespace weft::WEFT_KERNEL_SET {

void viscous_springs(const ViscousRow& row, Row3 force);
void scale(int n, const float* factor, Row3 row);
void accelerate(int n, const AcceleratedRow& row, Row3 position, Row3 velocity);
void moments(int n, const MomentRow& row, double* sums);
void dense_rows(int first, int last, const DenseMatrix& matrix, ConstRow3 vectors, Row3 out);
void add_rows(int n, const float* a, const float* b, float* out);
void patch_row(int n, const float* const* rows, const PatchWeights& patch, float* lines,
               float* out);

extern const FilteringKernels filtering;

}  // namespace weft::WEFT_KERNEL_SET
