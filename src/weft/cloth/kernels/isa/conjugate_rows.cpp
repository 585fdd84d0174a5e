#include "weft/cloth/kernels/isa/dot.h"
#include "weft/cloth/kernels/isa/rows.h"

// Vector operations of conjugate gradients.

namespace weft::WEFT_KERNEL_SET {

void subtract(int n, ConstRow3 a, ConstRow3 b, Row3 out) {
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    out.x[c] = a.x[c] - b.x[c];
    out.y[c] = a.y[c] - b.y[c];
    out.z[c] = a.z[c] - b.z[c];
  }
}

void scale_add(int n, ConstRow3 a, float factor, Row3 out) {
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    out.x[c] = a.x[c] + factor * out.x[c];
    out.y[c] = a.y[c] + factor * out.y[c];
    out.z[c] = a.z[c] + factor * out.z[c];
  }
}

void scale_row(int n, float factor, Row3 out) {
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    out.x[c] *= factor;
    out.y[c] *= factor;
    out.z[c] *= factor;
  }
}

void add_scaled(int n, float factor, ConstRow3 a, Row3 out) {
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    out.x[c] += factor * a.x[c];
    out.y[c] += factor * a.y[c];
    out.z[c] += factor * a.z[c];
  }
}

double newton_dot(int n, const float* share, ConstRow3 a, ConstRow3 b) {
  return lane_dot(n, share, a, b);
}

double update(int n, const float* share, ConstRow3 z, float factor, ConstRow3 residual,
              Row3 direction) {
  scale_add(n, z, factor, direction);
  return lane_dot(n, share, residual, {direction.x, direction.y, direction.z});
}

float advance(int n, float length, ConstRow3 direction, ConstRow3 product, Row3 step,
              Row3 residual) {
  add_scaled(n, length, direction, step);
  add_scaled(n, -length, product, residual);
  float maximum = 0;
  // The largest is the same in any order.
#pragma omp simd reduction(max : maximum)
  for (int c = 0; c < n; ++c) {
    const float squared = direction.x[c] * direction.x[c] + direction.y[c] * direction.y[c] +
                          direction.z[c] * direction.z[c];
    maximum = squared > maximum ? squared : maximum;
  }
  return maximum;
}

}  // namespace weft::WEFT_KERNEL_SET
