#include "weft/cloth/kernels/isa/rows.h"

namespace weft::WEFT_KERNEL_SET {
namespace {

/// How far the first end of a spring moves along its vector per unit of its inverse mass.
inline __attribute__((always_inline)) float correction(float squared, float low, float high,
                                                       float inverse_masses) {
  const float length = __builtin_sqrtf(squared);
  const float wanted = length > high ? high : (length < low ? low : length);
  const float shift = (length - wanted) / (length * inverse_masses);
  return squared > 0 && inverse_masses > 0 ? shift : 0.0F;
}

template <int Step>
bool breaks(const LimitedRows& rows) {
  const ConstRow3 a{rows.here.x, rows.here.y, rows.here.z};
  const ConstRow3 b{rows.there.x, rows.there.y, rows.there.z};
  const float shortest = rows.shortest, longest = rows.longest;
  const float* rest = rows.rest_length;
  const int shift = rows.shift;
  int broken = 0;
#pragma omp simd reduction(| : broken)
  for (int c = rows.first; c < rows.last; c += Step) {
    const int d = c + shift;
    const float dx = b.x[d] - a.x[c], dy = b.y[d] - a.y[c], dz = b.z[d] - a.z[c];
    const float squared = dx * dx + dy * dy + dz * dz;
    const float low = shortest * rest[c], high = longest * rest[c];
    broken |= static_cast<int>(squared > high * high) | static_cast<int>(squared < low * low);
  }
  return broken != 0;
}

/// No two of the springs share a particle.
template <int Step>
void limit_run(const LimitedRows& rows) {
  const Row3 a = rows.here, b = rows.there, va = rows.here_velocity, vb = rows.there_velocity;
  const float *wa = rows.here_inverse_mass, *wb = rows.there_inverse_mass;
  const float* rest = rows.rest_length;
  const float shortest = rows.shortest, longest = rows.longest, per_step = rows.inverse_step;
  const float relaxation = rows.relaxation;
  const int shift = rows.shift;
#pragma omp simd
  for (int c = rows.first; c < rows.last; c += Step) {
    const int d = c + shift;
    const float dx = b.x[d] - a.x[c], dy = b.y[d] - a.y[c], dz = b.z[d] - a.z[c];
    const float squared = dx * dx + dy * dy + dz * dz;
    const float s =
        relaxation * correction(squared, shortest * rest[c], longest * rest[c], wa[c] + wb[d]);
    const float si = s * wa[c], sj = s * wb[d];
    const float vi = si * per_step, vj = sj * per_step;
    a.x[c] += si * dx;
    a.y[c] += si * dy;
    a.z[c] += si * dz;
    b.x[d] -= sj * dx;
    b.y[d] -= sj * dy;
    b.z[d] -= sj * dz;
    va.x[c] += vi * dx;
    va.y[c] += vi * dy;
    va.z[c] += vi * dz;
    vb.x[d] -= vj * dx;
    vb.y[d] -= vj * dy;
    vb.z[d] -= vj * dz;
  }
}

}  // namespace

bool breaks_limit(const LimitedRows& rows) {
  return rows.step == 2 ? breaks<2>(rows) : breaks<1>(rows);
}

void limit(const LimitedRows& rows) {
  if (rows.step == 2)
    limit_run<2>(rows);
  else
    limit_run<1>(rows);
}

}  // namespace weft::WEFT_KERNEL_SET
