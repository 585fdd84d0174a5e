#include "weft/cloth/kernels/isa/newton_rows.h"

namespace weft::WEFT_KERNEL_SET {
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
