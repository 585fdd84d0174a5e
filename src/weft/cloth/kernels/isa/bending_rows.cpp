#include "weft/cloth/kernels/isa/rows.h"

namespace weft::WEFT_KERNEL_SET {

void add_differences(const DifferenceRow& row, Row3 out) {
  const ConstRow3 here = row.here, there = row.there;
  const float* weight = row.weight;
  const int shift = row.shift;
  float* __restrict x = out.x, * __restrict y = out.y, * __restrict z = out.z;
#pragma omp simd
  for (int c = row.first; c < row.last; ++c) {
    x[c] += weight[c] * (there.x[c + shift] - here.x[c]);
    y[c] += weight[c] * (there.y[c + shift] - here.y[c]);
    z[c] += weight[c] * (there.z[c + shift] - here.z[c]);
  }
}

void add_transposed(const TransposedRow& row, Row3 out) {
  const ConstRow3 u = row.here, other = row.there;
  const float *own = row.own, *theirs = row.theirs;
  const float factor = row.factor;
  const int shift = row.shift;
  float* __restrict x = out.x, * __restrict y = out.y, * __restrict z = out.z;
#pragma omp simd
  for (int c = row.first; c < row.last; ++c) {
    const float a = factor * own[c], b = factor * theirs[c + shift];
    x[c] += a * u.x[c] - b * other.x[c + shift];
    y[c] += a * u.y[c] - b * other.y[c + shift];
    z[c] += a * u.z[c] - b * other.z[c + shift];
  }
}

}  // namespace weft::WEFT_KERNEL_SET
