#include "weft/cloth/kernels/isa/rows.h"

// Springs as seen from one of their ends and their matrix in implicit Euler, and the start and end
// of a step.
namespace weft::WEFT_KERNEL_SET {
namespace {

/// Lower bound of a spring's squared length, which keeps its force finite. [m^2]
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

void fall(int n, const StartRow& start, Row3 velocity) {
  const ConstRow3 v = start.velocity;
  const float h = start.time_step;
  const float gx = h * start.gravity[0], gy = h * start.gravity[1], gz = h * start.gravity[2];
  float* __restrict x = velocity.x, * __restrict y = velocity.y, * __restrict z = velocity.z;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    x[c] = v.x[c] + gx;
    y[c] = v.y[c] + gy;
    z[c] = v.z[c] + gz;
  }
}

void right_side(int n, const StartRow& start, Row3 out) {
  const ConstRow3 v = start.velocity, f = start.force;
  const float *mass = start.mass, *count = start.count;
  const float h = start.time_step;
  const float gx = h * start.gravity[0], gy = h * start.gravity[1], gz = h * start.gravity[2];
  float* __restrict x = out.x, * __restrict y = out.y, * __restrict z = out.z;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    const float own = mass[c] * count[c];
    x[c] = own * (v.x[c] + gx) + h * f.x[c];
    y[c] = own * (v.y[c] + gy) + h * f.y[c];
    z[c] = own * (v.z[c] + gz) + h * f.z[c];
  }
}

void move(int n, const StartRow& start, ConstRow3 velocity, Row3 position) {
  const ConstRow3 x = start.position, v = velocity;
  const float h = start.time_step;
  float* __restrict px = position.x, * __restrict py = position.y, * __restrict pz = position.z;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    px[c] = x.x[c] + h * v.x[c];
    py[c] = x.y[c] + h * v.y[c];
    pz[c] = x.z[c] + h * v.z[c];
  }
}

void advance(int n, const StartRow& start, Row3 position, Row3 velocity) {
  const ConstRow3 x = start.position, v = start.velocity, f = start.force;
  const float* inverse_mass = start.mass;
  const float h = start.time_step, *g = start.gravity;
  const float gx = g[0], gy = g[1], gz = g[2];
  float* __restrict px = position.x, * __restrict py = position.y, * __restrict pz = position.z;
  float* __restrict vx = velocity.x, * __restrict vy = velocity.y, * __restrict vz = velocity.z;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    vx[c] = v.x[c] + h * (f.x[c] * inverse_mass[c] + gx);
    vy[c] = v.y[c] + h * (f.y[c] * inverse_mass[c] + gy);
    vz[c] = v.z[c] + h * (f.z[c] * inverse_mass[c] + gz);
    px[c] = x.x[c] + h * vx[c];
    py[c] = x.y[c] + h * vy[c];
    pz[c] = x.z[c] + h * vz[c];
  }
}

}  // namespace weft::WEFT_KERNEL_SET
