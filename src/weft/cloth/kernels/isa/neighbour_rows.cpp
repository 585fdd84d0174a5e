#include "weft/cloth/kernels/isa/implicit_rows.h"

// Springs as seen from one of their ends, and implicit Euler's matrix of them.

namespace weft::WEFT_KERNEL_SET {
namespace {

/// A spring shorter than its root [m] has no direction and pulls nowhere.
constexpr float min_squared_length = 1e-30F;

inline __attribute__((always_inline)) float bounded(float squared) {
  return squared > min_squared_length ? squared : min_squared_length;
}

}  // namespace

void elastic(const NeighbourSprings& row, Row3 force) {
  const ConstRow3 x = row.position, y = row.other_position;
  const float *rest = row.rest_length, *stiffness = row.stiffness;
  float* __restrict fx = force.x, * __restrict fy = force.y, * __restrict fz = force.z;
#pragma omp simd
  for (int c = row.first; c < row.last; ++c) {
    const float dx = y.x[c] - x.x[c], dy = y.y[c] - x.y[c], dz = y.z[c] - x.z[c];
    const float length = __builtin_sqrtf(bounded(dx * dx + dy * dy + dz * dz));
    const float pull = stiffness[c] * (length - rest[c]) / length;
    fx[c] += pull * dx;
    fy[c] += pull * dy;
    fz[c] += pull * dz;
  }
}

void axial_damping(const NeighbourSprings& row, Row3 force) {
  const ConstRow3 x = row.position, y = row.other_position;
  const ConstRow3 v = row.velocity, u = row.other_velocity;
  const float* damping = row.damping;
  float* __restrict fx = force.x, * __restrict fy = force.y, * __restrict fz = force.z;
#pragma omp simd
  for (int c = row.first; c < row.last; ++c) {
    const float dx = y.x[c] - x.x[c], dy = y.y[c] - x.y[c], dz = y.z[c] - x.z[c];
    const float along = dx * (u.x[c] - v.x[c]) + dy * (u.y[c] - v.y[c]) + dz * (u.z[c] - v.z[c]);
    const float pull = damping[c] * along / bounded(dx * dx + dy * dy + dz * dz);
    fx[c] += pull * dx;
    fy[c] += pull * dy;
    fz[c] += pull * dz;
  }
}

void linearise(const NeighbourSprings& row, float time_step, float* transverse, Row3 axial) {
  const ConstRow3 x = row.position, y = row.other_position;
  const float *rest = row.rest_length, *stiffness = row.stiffness, *damping = row.damping;
  const float h = time_step;
  float* __restrict a = transverse;
  float* __restrict sx = axial.x, * __restrict sy = axial.y, * __restrict sz = axial.z;
#pragma omp simd
  for (int c = row.first; c < row.last; ++c) {
    const float dx = y.x[c] - x.x[c], dy = y.y[c] - x.y[c], dz = y.z[c] - x.z[c];
    const float length = __builtin_sqrtf(bounded(dx * dx + dy * dy + dz * dz));
    const float strain = 1 - rest[c] / length;
    const float whole = h * (h * stiffness[c] + damping[c]);
    const float across = strain > 0 ? h * h * stiffness[c] * strain : 0.0F;
    const float along = __builtin_sqrtf(whole - across) / length;
    a[c] = across;
    sx[c] = along * dx;
    sy[c] = along * dy;
    sz[c] = along * dz;
  }
}

void multiply(const NeighbourBlocks& row, Row3 out) {
  const ConstRow3 s = row.axial, v = row.value, u = row.other_value;
  const float* a = row.transverse;
  float* __restrict x = out.x, * __restrict y = out.y, * __restrict z = out.z;
#pragma omp simd
  for (int c = row.first; c < row.last; ++c) {
    const float dx = v.x[c] - u.x[c], dy = v.y[c] - u.y[c], dz = v.z[c] - u.z[c];
    const float along = s.x[c] * dx + s.y[c] * dy + s.z[c] * dz;
    x[c] += a[c] * dx + along * s.x[c];
    y[c] += a[c] * dy + along * s.y[c];
    z[c] += a[c] * dz + along * s.z[c];
  }
}

void add_blocks(const NeighbourBlocks& row, const BlockRowOut& out) {
  const ConstRow3 s = row.axial;
  const float* a = row.transverse;
  float* __restrict xx = out.xx, * __restrict xy = out.xy, * __restrict xz = out.xz;
  float* __restrict yy = out.yy, * __restrict yz = out.yz, * __restrict zz = out.zz;
#pragma omp simd
  for (int c = row.first; c < row.last; ++c) {
    xx[c] += a[c] + s.x[c] * s.x[c];
    xy[c] += s.x[c] * s.y[c];
    xz[c] += s.x[c] * s.z[c];
    yy[c] += a[c] + s.y[c] * s.y[c];
    yz[c] += s.y[c] * s.z[c];
    zz[c] += a[c] + s.z[c] * s.z[c];
  }
}

}  // namespace weft::WEFT_KERNEL_SET
