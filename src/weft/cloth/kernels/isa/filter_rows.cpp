#include "weft/cloth/kernels/isa/dot.h"
#include "weft/cloth/kernels/isa/rows.h"

namespace weft::WEFT_KERNEL_SET {
namespace {

/// One coordinate of -A x at column c, with the neighbours on the sides that exist. Computed from
/// differences: a particle's own weight would be lost in the rounding of its springs' stiffness.
template <bool Left, bool Right>
inline __attribute__((always_inline)) float minus_ax(const OperatorRow& a, int c,
                                                     const float* above, const float* here,
                                                     const float* below) {
  const float x = here[c];
  float sum = a.below[c] * (below[c] - x) + a.above[c] * (above[c] - x);
  if (Right) {
    sum += a.right[c] * (here[c + 1] - x);
    sum += a.below_right[c] * (below[c + 1] - x);
    sum += a.above_right[c + 1] * (above[c + 1] - x);
  }
  if (Left) {
    sum += a.right[c - 1] * (here[c - 1] - x);
    sum += a.below_left[c] * (below[c - 1] - x);
    sum += a.above_left[c - 1] * (above[c - 1] - x);
  }
  return sum - a.weight[c] * x;
}

template <bool Left, bool Right>
inline __attribute__((always_inline)) void apply_at(const OperatorRow& a, const StencilRows& x,
                                                    int c, Row3 out) {
  out.x[c] = minus_ax<Left, Right>(a, c, x.above.x, x.here.x, x.below.x);
  out.y[c] = minus_ax<Left, Right>(a, c, x.above.y, x.here.y, x.below.y);
  out.z[c] = minus_ax<Left, Right>(a, c, x.above.z, x.here.z, x.below.z);
}

/// line = a / 2 + b + c / 2.
inline void weigh_rows(int n, const float* a, const float* b, const float* c,
                       float* __restrict line) {
#pragma omp simd
  for (int i = 0; i < n; ++i) line[i] = b[i] + 0.5F * (a[i] + c[i]);
}

inline void weigh_columns(int n, const float* line, float* __restrict out) {
  const int last = (n - 1) / 2;
  out[0] = line[0] + 0.5F * line[1];
#pragma omp simd
  for (int c = 1; c < last; ++c) out[c] = line[2 * c] + 0.5F * (line[2 * c - 1] + line[2 * c + 1]);
  out[last] = line[n - 1] + 0.5F * line[n - 2];
}

inline void interpolate_row(int n, const float* a, const float* b, const float* inverse,
                            float* __restrict line, float* __restrict out) {
  const int coarse = (n + 1) / 2;
#pragma omp simd
  for (int c = 0; c < coarse; ++c) line[c] = 0.5F * (a[c] + b[c]);
#pragma omp simd
  for (int c = 0; c < coarse; ++c) out[2 * c] += inverse[2 * c] > 0 ? line[c] : 0.0F;
#pragma omp simd
  for (int c = 0; c < coarse - 1; ++c)
    out[2 * c + 1] += inverse[2 * c + 1] > 0 ? 0.5F * (line[c] + line[c + 1]) : 0.0F;
}

}  // namespace

void first_sweep(int n, float factor, const float* inverse, ConstRow3 rhs, Row3 out) {
  float* __restrict x = out.x, * __restrict y = out.y, * __restrict z = out.z;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    const float step = factor * inverse[c];
    x[c] = step * rhs.x[c];
    y[c] = step * rhs.y[c];
    z[c] = step * rhs.z[c];
  }
}

void apply(int n, const OperatorRow& row, const StencilRows& x, Row3 out) {
  const OperatorRow a = row;
  const StencilRows s = x;
  float* __restrict ox = out.x, * __restrict oy = out.y, * __restrict oz = out.z;
  apply_at<false, true>(a, s, 0, {ox, oy, oz});
#pragma omp simd
  for (int c = 1; c < n - 1; ++c) {
    ox[c] = minus_ax<true, true>(a, c, s.above.x, s.here.x, s.below.x);
    oy[c] = minus_ax<true, true>(a, c, s.above.y, s.here.y, s.below.y);
    oz[c] = minus_ax<true, true>(a, c, s.above.z, s.here.z, s.below.z);
  }
  apply_at<true, false>(a, s, n - 1, {ox, oy, oz});
}

void add_rhs(int n, const float* share, const float* inverse, ConstRow3 rhs, Row3 out) {
  float* __restrict x = out.x, * __restrict y = out.y, * __restrict z = out.z;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    const float own = share == nullptr ? 1.0F : share[c];
    const float moves = inverse[c] > 0 ? 1.0F : 0.0F;
    x[c] = moves * (x[c] + own * rhs.x[c]);
    y[c] = moves * (y[c] + own * rhs.y[c]);
    z[c] = moves * (z[c] + own * rhs.z[c]);
  }
}

double sweep(int n, const SweepRow& row, Row3 out) {
  const float *inverse = row.inverse, *count = row.count;
  const ConstRow3 b = row.rhs, v = row.value;
  float* __restrict x = out.x, * __restrict y = out.y, * __restrict z = out.z;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    const float step = row.factor * inverse[c];
    const float copies = count == nullptr ? 1.0F : count[c];
    x[c] = v.x[c] + step * (b.x[c] + copies * x[c]);
    y[c] = v.y[c] + step * (b.y[c] + copies * y[c]);
    z[c] = v.z[c] + step * (b.z[c] + copies * z[c]);
  }
  return lane_dot(n, row.share, b, {x, y, z});
}

void restrict_rows(int n, const StencilRows& fine, Row3 lines, Row3 out) {
  weigh_rows(n, fine.above.x, fine.here.x, fine.below.x, lines.x);
  weigh_rows(n, fine.above.y, fine.here.y, fine.below.y, lines.y);
  weigh_rows(n, fine.above.z, fine.here.z, fine.below.z, lines.z);
  weigh_columns(n, lines.x, out.x);
  weigh_columns(n, lines.y, out.y);
  weigh_columns(n, lines.z, out.z);
}

void interpolate(int n, ConstRow3 a, ConstRow3 b, const float* inverse, Row3 lines, Row3 out) {
  interpolate_row(n, a.x, b.x, inverse, lines.x, out.x);
  interpolate_row(n, a.y, b.y, inverse, lines.y, out.y);
  interpolate_row(n, a.z, b.z, inverse, lines.z, out.z);
}

void subtract_blocks(int n, const BlockRow& blocks, ConstRow3 in, Row3 out) {
  const float *xx = blocks.xx, *xy = blocks.xy, *xz = blocks.xz;
  const float *yy = blocks.yy, *yz = blocks.yz, *zz = blocks.zz;
  float* __restrict x = out.x, * __restrict y = out.y, * __restrict z = out.z;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    x[c] -= xx[c] * in.x[c] + xy[c] * in.y[c] + xz[c] * in.z[c];
    y[c] -= xy[c] * in.x[c] + yy[c] * in.y[c] + yz[c] * in.z[c];
    z[c] -= xz[c] * in.x[c] + yz[c] * in.y[c] + zz[c] * in.z[c];
  }
}

void apply_blocks(int n, float factor, const BlockRow& blocks, ConstRow3 in, Row3 out) {
  const float *xx = blocks.xx, *xy = blocks.xy, *xz = blocks.xz;
  const float *yy = blocks.yy, *yz = blocks.yz, *zz = blocks.zz;
  float* __restrict x = out.x, * __restrict y = out.y, * __restrict z = out.z;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    const float p = factor * in.x[c], q = factor * in.y[c], r = factor * in.z[c];
    x[c] = xx[c] * p + xy[c] * q + xz[c] * r;
    y[c] = xy[c] * p + yy[c] * q + yz[c] * r;
    z[c] = xz[c] * p + yz[c] * q + zz[c] * r;
  }
}

void block_sweep(int n, const BlockSweepRow& row, Row3 out) {
  const float *xx = row.inverse.xx, *xy = row.inverse.xy, *xz = row.inverse.xz;
  const float *yy = row.inverse.yy, *yz = row.inverse.yz, *zz = row.inverse.zz;
  const float* count = row.count;
  const ConstRow3 rhs = row.rhs, value = row.value;
  const float factor = row.factor;
  float* __restrict x = out.x, * __restrict y = out.y, * __restrict z = out.z;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    const float copies = count == nullptr ? 1.0F : count[c];
    const float p = factor * (rhs.x[c] + copies * x[c]);
    const float q = factor * (rhs.y[c] + copies * y[c]);
    const float r = factor * (rhs.z[c] + copies * z[c]);
    x[c] = value.x[c] + (xx[c] * p + xy[c] * q + xz[c] * r);
    y[c] = value.y[c] + (xy[c] * p + yy[c] * q + yz[c] * r);
    z[c] = value.z[c] + (xz[c] * p + yz[c] * q + zz[c] * r);
  }
}

}  // namespace weft::WEFT_KERNEL_SET
