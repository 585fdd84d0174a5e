#include "weft/cloth/kernels/isa/filtering_rows.h"

namespace weft::WEFT_KERNEL_SET {
namespace {

/// A spring shorter than its root [m] has no direction and pulls nowhere.
constexpr float min_squared_length = 1e-30F;

}  // namespace

void viscous_springs(const ViscousRow& row, Row3 force) {
  const ConstRow3 x = row.position, y = row.other_position, v = row.velocity,
                  u = row.other_velocity;
  const float* __restrict rest = row.rest_length, * __restrict stiffness = row.stiffness;
  const float* __restrict viscosity = row.viscosity;
  float* __restrict fx = force.x, * __restrict fy = force.y, * __restrict fz = force.z;
#pragma omp simd
  for (int c = row.first; c < row.last; ++c) {
    const float dx = y.x[c] - x.x[c], dy = y.y[c] - x.y[c], dz = y.z[c] - x.z[c];
    const float squared = dx * dx + dy * dy + dz * dz;
    const float length =
        __builtin_sqrtf(squared > min_squared_length ? squared : min_squared_length);
    const float pull = stiffness[c] * ((length - rest[c]) / length), lag = viscosity[c];
    fx[c] += pull * dx + lag * (u.x[c] - v.x[c]);
    fy[c] += pull * dy + lag * (u.y[c] - v.y[c]);
    fz[c] += pull * dz + lag * (u.z[c] - v.z[c]);
  }
}

void accelerate(int n, const AcceleratedRow& row, Row3 position, Row3 velocity) {
  const ConstRow3 x = row.position, v = row.velocity, a = row.acceleration;
  const float h = row.time_step, *o = row.centre, *g = row.linear, *w = row.turn;
  float* __restrict x1 = position.x, * __restrict y1 = position.y, * __restrict z1 = position.z;
  float* __restrict u1 = velocity.x, * __restrict v1 = velocity.y, * __restrict w1 = velocity.z;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    const float dx = x.x[c] - o[0], dy = x.y[c] - o[1], dz = x.z[c] - o[2];
    u1[c] = v.x[c] + h * (a.x[c] + g[0] + (dy * w[2] - dz * w[1]));
    v1[c] = v.y[c] + h * (a.y[c] + g[1] + (dz * w[0] - dx * w[2]));
    w1[c] = v.z[c] + h * (a.z[c] + g[2] + (dx * w[1] - dy * w[0]));
    x1[c] = x.x[c] + h * u1[c];
    y1[c] = x.y[c] + h * v1[c];
    z1[c] = x.z[c] + h * w1[c];
  }
}

void scale(int n, const float* factor, Row3 row) {
  const float* __restrict f = factor;
  float* __restrict x = row.x, * __restrict y = row.y, * __restrict z = row.z;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    x[c] *= f[c];
    y[c] *= f[c];
    z[c] *= f[c];
  }
}

}  // namespace weft::WEFT_KERNEL_SET
