#include "weft/cloth/kernels/isa/rows.h"

namespace weft::WEFT_KERNEL_SET {

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
