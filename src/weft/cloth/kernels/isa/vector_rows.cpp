#include "weft/cloth/kernels/isa/dot.h"
#include "weft/cloth/kernels/isa/rows.h"

namespace weft::WEFT_KERNEL_SET {

float update_direction(int n, const DirectionRow& row) {
  const float step_length = row.step_length, beta = row.beta;
  const ConstRow3 y = row.fall, w = row.correction;
  float* __restrict zx = row.move.x, * __restrict zy = row.move.y, * __restrict zz = row.move.z;
  float *__restrict dx = row.direction.x, *__restrict dy = row.direction.y,
                    *__restrict dz = row.direction.z;
  float *__restrict px = row.position.x, *__restrict py = row.position.y,
                    *__restrict pz = row.position.z;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    zx[c] += step_length * dx[c];
    zy[c] += step_length * dy[c];
    zz[c] += step_length * dz[c];
    dx[c] = w.x[c] + beta * dx[c];
    dy[c] = w.y[c] + beta * dy[c];
    dz[c] = w.z[c] + beta * dz[c];
    px[c] = y.x[c] + (zx[c] + dx[c]);
    py[c] = y.y[c] + (zy[c] + dy[c]);
    pz[c] = y.z[c] + (zz[c] + dz[c]);
  }
  float largest = 0;
  // The largest is the same in any order.
#pragma omp simd reduction(max : largest)
  for (int c = 0; c < n; ++c) {
    const float squared = dx[c] * dx[c] + dy[c] * dy[c] + dz[c] * dz[c];
    largest = squared > largest ? squared : largest;
  }
  return largest;
}

void place(int n, const PlacedRow& row) {
  const float step_length = row.step_length, per_step = row.per_step;
  const float gx = row.gained[0], gy = row.gained[1], gz = row.gained[2];
  const ConstRow3 y = row.fall, z = row.move, d = row.direction, v = row.start_velocity;
  float *__restrict px = row.position.x, *__restrict py = row.position.y,
                    *__restrict pz = row.position.z;
  float *__restrict vx = row.velocity.x, *__restrict vy = row.velocity.y,
                    *__restrict vz = row.velocity.z;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    const float dx = z.x[c] + step_length * d.x[c];
    const float dy = z.y[c] + step_length * d.y[c];
    const float dz = z.z[c] + step_length * d.z[c];
    px[c] = y.x[c] + dx;
    py[c] = y.y[c] + dy;
    pz[c] = y.z[c] + dz;
    vx[c] = v.x[c] + gx + per_step * dx;
    vy[c] = v.y[c] + gy + per_step * dy;
    vz[c] = v.z[c] + gz + per_step * dz;
  }
}

double dot(int n, const float* share, ConstRow3 a, ConstRow3 b) { return lane_dot(n, share, a, b); }

void step_residual(int n, float step_length, ConstRow3 far, Row3 residual) {
  float* __restrict x = residual.x, * __restrict y = residual.y, * __restrict z = residual.z;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    x[c] += step_length * (far.x[c] - x[c]);
    y[c] += step_length * (far.y[c] - y[c]);
    z[c] += step_length * (far.z[c] - z[c]);
  }
}
namespace {

/// Largest finite float. A value that compares as greater, or not at all, is not finite.
constexpr float maximum = 3.40282347e38F;

inline __attribute__((always_inline)) int not_finite(float value) {
  return static_cast<int>(!(__builtin_fabsf(value) <= maximum));
}

}  // namespace

RowMotion motion(int n, const float* mass, ConstRow3 position, ConstRow3 velocity) {
  const ConstRow3 p = position, v = velocity;
  float largest = 0;
  int bad = 0;
  // Neither depends on the order.
#pragma omp simd reduction(max : largest) reduction(| : bad)
  for (int c = 0; c < n; ++c) {
    const float squared = v.x[c] * v.x[c] + v.y[c] * v.y[c] + v.z[c] * v.z[c];
    largest = squared > largest ? squared : largest;
    bad |= not_finite(p.x[c]) | not_finite(p.y[c]) | not_finite(p.z[c]) | not_finite(squared);
  }
  return {0.5 * lane_dot(n, mass, v, v), largest, bad == 0};
}

}  // namespace weft::WEFT_KERNEL_SET
