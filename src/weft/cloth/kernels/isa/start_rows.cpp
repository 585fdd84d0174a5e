#include "weft/cloth/kernels/isa/implicit_rows.h"

// What a step begins with, and where it leads.

namespace weft::WEFT_KERNEL_SET {

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
