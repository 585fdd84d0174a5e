#include "weft/cloth/kernels/isa/rows.h"

namespace weft::WEFT_KERNEL_SET {
namespace {

/// x -= entries times found, over a padded run.
inline __attribute__((always_inline)) void subtract(std::ptrdiff_t count, const float* entries,
                                                    float fx, float fy, float fz, Row3 x) {
  const float* __restrict e = entries;
  float* __restrict a = x.x, * __restrict b = x.y, * __restrict c = x.z;
  for (std::ptrdiff_t k = 0; k < count; k += envelope_padding) {
#pragma omp simd
    for (int i = 0; i < envelope_padding; ++i) {
      a[k + i] -= e[k + i] * fx;
      b[k + i] -= e[k + i] * fy;
      c[k + i] -= e[k + i] * fz;
    }
  }
}

}  // namespace

void substitute(const Envelope& factor, Row3 x) {
  for (int i = 0; i < factor.count; ++i) {
    const float pivot = factor.inverse_diagonal[i];
    const float fx = x.x[i] *= pivot, fy = x.y[i] *= pivot, fz = x.z[i] *= pivot;
    const std::ptrdiff_t start = factor.column_start[i];
    subtract(factor.column_start[i + 1] - start, factor.columns + start, fx, fy, fz,
             {x.x + i + 1, x.y + i + 1, x.z + i + 1});
  }
  for (int i = factor.count - 1; i >= 0; --i) {
    const float pivot = factor.inverse_diagonal[i];
    const float fx = x.x[i] *= pivot, fy = x.y[i] *= pivot, fz = x.z[i] *= pivot;
    const std::ptrdiff_t start = factor.row_start[i];
    const std::ptrdiff_t count = factor.row_start[i + 1] - start, first = i - count;
    subtract(count, factor.rows + start, fx, fy, fz, {x.x + first, x.y + first, x.z + first});
  }
}

}  // namespace weft::WEFT_KERNEL_SET
