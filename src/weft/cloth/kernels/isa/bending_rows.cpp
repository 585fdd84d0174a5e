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
namespace {

// The neighbours in the order of bending_offsets: right, left, below, above, below right, above
// left, below left, above right.

/// One coordinate of the second difference.
inline float difference(const BendingRows& rows, const float* above, const float* here,
                        const float* below, int c) {
  const float at = here[c];
  return rows.weight[0][c] * (here[c + 1] - at) + rows.weight[1][c] * (here[c - 1] - at) +
         rows.weight[2][c] * (below[c] - at) + rows.weight[3][c] * (above[c] - at);
}
inline float diagonal_difference(const BendingRows& rows, const float* above, const float* here,
                                 const float* below, int c) {
  const float at = here[c];
  return rows.weight[4][c] * (below[c + 1] - at) + rows.weight[5][c] * (above[c - 1] - at) +
         rows.weight[6][c] * (below[c - 1] - at) + rows.weight[7][c] * (above[c + 1] - at);
}

inline float transposed(const BendingRows& own, const BendingRows& back, const float* above,
                        const float* here, const float* below, int c) {
  const float own_sum = own.weight[0][c] + own.weight[1][c] + own.weight[2][c] + own.weight[3][c];
  return back.weight[0][c] * here[c + 1] + back.weight[1][c] * here[c - 1] +
         back.weight[2][c] * below[c] + back.weight[3][c] * above[c] - own_sum * here[c];
}
inline float diagonal_transposed(const BendingRows& own, const BendingRows& back,
                                 const float* above, const float* here, const float* below, int c) {
  const float own_sum = own.weight[4][c] + own.weight[5][c] + own.weight[6][c] + own.weight[7][c];
  return back.weight[4][c] * below[c + 1] + back.weight[5][c] * above[c - 1] +
         back.weight[6][c] * below[c - 1] + back.weight[7][c] * above[c + 1] - own_sum * here[c];
}

}  // namespace

void bend(int n, const BendingRows& rows, const RowTriple& x, Row3 u) {
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    u.x[c] = difference(rows, x.above.x, x.here.x, x.below.x, c);
    u.y[c] = difference(rows, x.above.y, x.here.y, x.below.y, c);
    u.z[c] = difference(rows, x.above.z, x.here.z, x.below.z, c);
  }
  if (rows.neighbours <= 4) return;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    u.x[c] += diagonal_difference(rows, x.above.x, x.here.x, x.below.x, c);
    u.y[c] += diagonal_difference(rows, x.above.y, x.here.y, x.below.y, c);
    u.z[c] += diagonal_difference(rows, x.above.z, x.here.z, x.below.z, c);
  }
}

void unbend(int n, const BendingRows& own, const BendingRows& back, const RowTriple& u, Row3 out) {
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    out.x[c] += transposed(own, back, u.above.x, u.here.x, u.below.x, c);
    out.y[c] += transposed(own, back, u.above.y, u.here.y, u.below.y, c);
    out.z[c] += transposed(own, back, u.above.z, u.here.z, u.below.z, c);
  }
  if (own.neighbours <= 4) return;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    out.x[c] += diagonal_transposed(own, back, u.above.x, u.here.x, u.below.x, c);
    out.y[c] += diagonal_transposed(own, back, u.above.y, u.here.y, u.below.y, c);
    out.z[c] += diagonal_transposed(own, back, u.above.z, u.here.z, u.below.z, c);
  }
}

}  // namespace weft::WEFT_KERNEL_SET
