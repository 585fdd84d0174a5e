#include "weft/cloth/kernels/isa/rows.h"

// Conjugate gradients and their preconditioner.

namespace weft::WEFT_KERNEL_SET {
namespace {

struct Block {
  float xx, xy, xz, yy, yz, zz;
};

inline __attribute__((always_inline)) Block inverse(const Block& m) {
  const float scale = 1 / (m.xx + m.yy + m.zz);
  const float a = m.xx * scale, b = m.xy * scale, d = m.xz * scale;
  const float e = m.yy * scale, f = m.yz * scale, g = m.zz * scale;
  const float c0 = e * g - f * f, c1 = d * f - b * g, c2 = b * f - d * e;
  const float factor = scale / (a * c0 + b * c1 + d * c2);
  return {factor * c0,
          factor * c1,
          factor * c2,
          factor * (a * g - d * d),
          factor * (b * d - a * f),
          factor * (a * e - b * b)};
}

template <bool HasMass, bool HasMoves>
void invert(int n, const InvertedRow& row, const BlockRowOut& out) {
  const BlockRow b = row.block, k = row.contact;
  const float *mass = row.mass, *moves = row.moves;
  const float p = row.block_factor, q = row.contact_factor, m = row.mass_factor;
  float* __restrict xx = out.xx, * __restrict xy = out.xy, * __restrict xz = out.xz;
  float* __restrict yy = out.yy, * __restrict yz = out.yz, * __restrict zz = out.zz;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    const float own = HasMass ? m * mass[c] : 0.0F;
    const Block sum{p * b.xx[c] + q * k.xx[c] + own, p * b.xy[c] + q * k.xy[c],
                    p * b.xz[c] + q * k.xz[c],       p * b.yy[c] + q * k.yy[c] + own,
                    p * b.yz[c] + q * k.yz[c],       p * b.zz[c] + q * k.zz[c] + own};
    const bool holds = (HasMoves ? moves[c] : sum.xx + sum.yy + sum.zz) > 0;
    const Block result = inverse(sum);
    xx[c] = holds ? result.xx : 0.0F;
    xy[c] = holds ? result.xy : 0.0F;
    xz[c] = holds ? result.xz : 0.0F;
    yy[c] = holds ? result.yy : 0.0F;
    yz[c] = holds ? result.yz : 0.0F;
    zz[c] = holds ? result.zz : 0.0F;
  }
}

inline void weigh(int n, float share, const float* values, const float* weights,
                  float* __restrict line) {
  if (weights == nullptr) {
#pragma omp simd
    for (int c = 0; c < n; ++c) line[c] += share * values[c];
  } else {
#pragma omp simd
    for (int c = 0; c < n; ++c) line[c] += share * (weights[c] * values[c]);
  }
}

}  // namespace

void add_mass(int n, const float* mass, ConstRow3 value, Row3 out) {
  float* __restrict x = out.x, * __restrict y = out.y, * __restrict z = out.z;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    x[c] += mass[c] * value.x[c];
    y[c] += mass[c] * value.y[c];
    z[c] += mass[c] * value.z[c];
  }
}

void invert_blocks(int n, const InvertedRow& row, const BlockRowOut& out) {
  if (row.mass == nullptr)
    row.moves == nullptr ? invert<false, false>(n, row, out) : invert<false, true>(n, row, out);
  else
    row.moves == nullptr ? invert<true, false>(n, row, out) : invert<true, true>(n, row, out);
}

void multiply_blocks(int n, const BlockRow& blocks, Row3 value) {
  const BlockRow b = blocks;
  float* __restrict x = value.x, * __restrict y = value.y, * __restrict z = value.z;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    const float p = x[c], q = y[c], r = z[c];
    x[c] = b.xx[c] * p + b.xy[c] * q + b.xz[c] * r;
    y[c] = b.xy[c] * p + b.yy[c] * q + b.yz[c] * r;
    z[c] = b.xz[c] * p + b.yz[c] * q + b.zz[c] * r;
  }
}

float gradient_step(int n, const GradientStepRow& row) {
  const float alpha = row.alpha;
  const ConstRow3 p = row.direction, q = row.image;
  float* __restrict vx = row.value.x, * __restrict vy = row.value.y, * __restrict vz = row.value.z;
  float *__restrict rx = row.residual.x, *__restrict ry = row.residual.y,
                    *__restrict rz = row.residual.z;
  float largest = 0;
  // The largest is the same in any order.
#pragma omp simd reduction(max : largest)
  for (int c = 0; c < n; ++c) {
    const float squared = p.x[c] * p.x[c] + p.y[c] * p.y[c] + p.z[c] * p.z[c];
    largest = squared > largest ? squared : largest;
    vx[c] += alpha * p.x[c];
    vy[c] += alpha * p.y[c];
    vz[c] += alpha * p.z[c];
    rx[c] -= alpha * q.x[c];
    ry[c] -= alpha * q.y[c];
    rz[c] -= alpha * q.z[c];
  }
  return largest;
}

void update_direction(int n, float beta, ConstRow3 correction, Row3 direction) {
  const ConstRow3 w = correction;
  float* __restrict x = direction.x, * __restrict y = direction.y, * __restrict z = direction.z;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    x[c] = w.x[c] + beta * x[c];
    y[c] = w.y[c] + beta * y[c];
    z[c] = w.z[c] + beta * z[c];
  }
}

void subtract(int n, ConstRow3 value, Row3 out) {
  float* __restrict x = out.x, * __restrict y = out.y, * __restrict z = out.z;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    x[c] -= value.x[c];
    y[c] -= value.y[c];
    z[c] -= value.z[c];
  }
}

void restrict_plane(int n, const WeighedRows& fine, float* line, float* out) {
  for (int c = 0; c < n; ++c) line[c] = 0;
  weigh(n, 1, fine.here, fine.here_weight, line);
  if (fine.above != nullptr) weigh(n, 0.5F, fine.above, fine.above_weight, line);
  if (fine.below != nullptr) weigh(n, 0.5F, fine.below, fine.below_weight, line);
  const int last = (n - 1) / 2;
  float* __restrict to = out;
  to[0] = line[0] + 0.5F * line[1];
#pragma omp simd
  for (int c = 1; c < last; ++c) to[c] = line[2 * c] + 0.5F * (line[2 * c - 1] + line[2 * c + 1]);
  to[last] = line[n - 1] + 0.5F * line[n - 2];
}

}  // namespace weft::WEFT_KERNEL_SET
