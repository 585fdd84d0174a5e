#include "weft/cloth/kernels/rows/dot.h"
#include "weft/cloth/kernels/rows/rows.h"

namespace weft::WEFT_KERNEL_SET {
namespace {

/// Springs of no length have no direction: their pull is bounded instead of infinite. [m^2]
constexpr float least_squared_length = 1e-24F;

/// Force of a spring over its vector (dx, dy, dz) [N/m]; (ex, ey, ez) is how that changed in the
/// step [m].
template <bool damped>
inline __attribute__((always_inline)) float pull(float dx, float dy, float dz, float ex, float ey,
                                                 float ez, float k, float rest, float damping) {
  const float squared = dx * dx + dy * dy + dz * dz;
  const float length =
      __builtin_sqrtf(squared > least_squared_length ? squared : least_squared_length);
  const float inverse = 1 / length;
  const float elastic = k * (length - rest);
  if (!damped) return elastic * inverse;
  const float along = dx * ex + dy * ey + dz * ez;
  return (elastic + damping * (along * inverse)) * inverse;
}

/// The forces of the springs from a[c] to b[c + shift], first <= c < last.
template <bool damped>
inline __attribute__((always_inline)) void spring_forces(int first, int last, int shift,
                                                         const SpringRow& springs, float per_step,
                                                         const MovingRow& a, const MovingRow& b,
                                                         Row3 force) {
  const float* __restrict k = springs.stiffness;
  const float* __restrict rest = springs.rest_length;
  const float* __restrict damping = springs.damping;
  const ConstRow3 p = a.position, q = b.position, p0 = a.start, q0 = b.start;
  float* __restrict fx = force.x, * __restrict fy = force.y, * __restrict fz = force.z;
#pragma omp simd
  for (int c = first; c < last; ++c) {
    const int d = c + shift;
    const float dx = q.x[d] - p.x[c], dy = q.y[d] - p.y[c], dz = q.z[d] - p.z[c];
    float ex = 0, ey = 0, ez = 0, damp = 0;
    if (damped) {
      ex = dx - (q0.x[d] - p0.x[c]);
      ey = dy - (q0.y[d] - p0.y[c]);
      ez = dz - (q0.z[d] - p0.z[c]);
      damp = per_step * damping[c];
    }
    const float s = pull<damped>(dx, dy, dz, ex, ey, ez, k[c], rest[c], damp);
    fx[c] = s * dx;
    fy[c] = s * dy;
    fz[c] = s * dz;
  }
}

inline void forces(int first, int last, int shift, const SpringRow& springs, float per_step,
                   const MovingRow& a, const MovingRow& b, Row3 force) {
  if (springs.damping == nullptr)
    spring_forces<false>(first, last, shift, springs, per_step, a, b, force);
  else
    spring_forces<true>(first, last, shift, springs, per_step, a, b, force);
}

inline void add(int first, int last, const float* __restrict from, float* __restrict to) {
#pragma omp simd
  for (int c = first; c < last; ++c) to[c] += from[c];
}

inline void subtract(int first, int last, int shift, const float* __restrict from,
                     float* __restrict to) {
#pragma omp simd
  for (int c = first; c < last; ++c) to[c + shift] -= from[c];
}

inline void share_out(int first, int last, int shift, Row3 force, Row3 here, Row3 there) {
  add(first, last, force.x, here.x);
  add(first, last, force.y, here.y);
  add(first, last, force.z, here.z);
  subtract(first, last, shift, force.x, there.x);
  subtract(first, last, shift, force.y, there.y);
  subtract(first, last, shift, force.z, there.z);
}

}  // namespace

void springs_along(int n, int gap, const SpringRow& springs, float per_step, const MovingRow& row,
                   Row3 lines, Row3 out) {
  forces(0, n - gap, gap, springs, per_step, row, row, lines);
  share_out(0, n - gap, gap, lines, out, out);
}

void springs_across(int n, int shift, const SpringRow& springs, float per_step, const RowPair& rows,
                    Row3 lines, Row3 out, Row3 out_there) {
  const int first = shift < 0 ? -shift : 0, last = shift > 0 ? n - shift : n;
  forces(first, last, shift, springs, per_step, rows.here, rows.there, lines);
  share_out(first, last, shift, lines, out, out_there);
}

double inertia(int n, const float* weight, ConstRow3 move, ConstRow3 direction, Row3 force) {
  const float* __restrict w = weight;
  const ConstRow3 z = move, d = direction;
  float* __restrict fx = force.x, * __restrict fy = force.y, * __restrict fz = force.z;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    fx[c] -= w[c] * (z.x[c] + d.x[c]);
    fy[c] -= w[c] * (z.y[c] + d.y[c]);
    fz[c] -= w[c] * (z.z[c] + d.z[c]);
  }
  return lane_dot(n, nullptr, {fx, fy, fz}, d);
}

}  // namespace weft::WEFT_KERNEL_SET
