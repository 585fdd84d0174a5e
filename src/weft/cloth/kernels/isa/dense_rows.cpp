#include "weft/cloth/kernels/isa/filtering_rows.h"

namespace weft::WEFT_KERNEL_SET {
namespace {

/// Sums go in this many lanes whatever the vector's width, so that they round alike.
constexpr int lanes = 16;

inline float folded(float* sums) {
  for (int half = lanes / 2; half > 0; half /= 2)
    for (int i = 0; i < half; ++i) sums[i] += sums[i + half];
  return sums[0];
}

/// `Together` rows, so that the vectors are read once for all.
template <int Together>
inline __attribute__((always_inline)) void rows_times(const float* matrix, std::ptrdiff_t stride,
                                                      ConstRow3 v, int first, Row3 out) {
  float sx[Together][lanes] = {}, sy[Together][lanes] = {}, sz[Together][lanes] = {};
  for (std::ptrdiff_t j = 0; j < stride; j += lanes)
    for (int r = 0; r < Together; ++r) {
      const float* row = matrix + (first + r) * stride + j;
#pragma omp simd
      for (int i = 0; i < lanes; ++i) {
        sx[r][i] += row[i] * v.x[j + i];
        sy[r][i] += row[i] * v.y[j + i];
        sz[r][i] += row[i] * v.z[j + i];
      }
    }
  for (int r = 0; r < Together; ++r) {
    out.x[first + r] = folded(sx[r]);
    out.y[first + r] = folded(sy[r]);
    out.z[first + r] = folded(sz[r]);
  }
}

}  // namespace

void dense_rows(int first, int last, const DenseMatrix& matrix, ConstRow3 vectors, Row3 out) {
  int r = first;
  for (; r + 2 <= last; r += 2) rows_times<2>(matrix.data, matrix.stride, vectors, r, out);
  if (r < last) rows_times<1>(matrix.data, matrix.stride, vectors, r, out);
}

}  // namespace weft::WEFT_KERNEL_SET
