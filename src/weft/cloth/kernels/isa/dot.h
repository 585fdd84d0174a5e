#pragma once

#include "weft/cloth/kernels/row_pointers.h"

namespace weft::WEFT_KERNEL_SET {
namespace {

/// Sums have this many lanes whatever the vector's width, so that they round alike.
constexpr int lanes = 16;

inline __attribute__((always_inline)) float product(const float* share, ConstRow3 a, ConstRow3 b,
                                                    int c) {
  const float sum = a.x[c] * b.x[c] + a.y[c] * b.y[c] + a.z[c] * b.z[c];
  return share == nullptr ? sum : share[c] * sum;
}

/// Sum of share a . b over a row; share null: 1.
inline double lane_dot(int n, const float* share, ConstRow3 a, ConstRow3 b) {
  alignas(64) float sums[lanes] = {};
  int c = 0;
  for (; c + lanes <= n; c += lanes)
#pragma omp simd
    for (int lane = 0; lane < lanes; ++lane) sums[lane] += product(share, a, b, c + lane);
  for (int lane = 0; c < n; ++c, ++lane) sums[lane] += product(share, a, b, c);
  double sum = 0;
  for (int lane = 0; lane < lanes; ++lane) sum += double{sums[lane]};
  return sum;
}

}  // namespace
}  // namespace weft::WEFT_KERNEL_SET
