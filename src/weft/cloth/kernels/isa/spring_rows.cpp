#include "weft/cloth/kernels/isa/dot.h"
#include "weft/cloth/kernels/isa/rows.h"

namespace weft::WEFT_KERNEL_SET {
namespace {

/// Lower bound of a spring's squared length, which keeps its force finite. [m^2]
constexpr float min_squared_length = 1e-24F;

struct Vector {
  float x, y, z;
};

/// Force of a spring over its vector d [N/m]; e is the change of d in the step [m].
template <bool Damped>
inline __attribute__((always_inline)) float pull(const Vector& d, const Vector& e, float k,
                                                 float rest, float damping) {
  const float squared = d.x * d.x + d.y * d.y + d.z * d.z;
  const float length = __builtin_sqrtf(squared > min_squared_length ? squared : min_squared_length);
  const float inverse = 1 / length;
  const float elastic = k * (length - rest);
  if (!Damped) return elastic * inverse;
  const float along = d.x * e.x + d.y * e.y + d.z * e.z;
  return (elastic + damping * (along * inverse)) * inverse;
}

template <bool Damped>
void spring_forces(const SpringRun& run, Row3 force) {
  const float* __restrict k = run.springs.stiffness;
  const float* __restrict rest = run.springs.rest_length;
  const float* __restrict damping = run.springs.damping;
  const ConstRow3 p = run.here.position, q = run.there.position;
  const ConstRow3 p0 = run.here.start, q0 = run.there.start;
  const int shift = run.shift;
  const float per_step = run.per_step;
  float* __restrict fx = force.x, * __restrict fy = force.y, * __restrict fz = force.z;
#pragma omp simd
  for (int c = run.first; c < run.last; ++c) {
    const int j = c + shift;
    const float dx = q.x[j] - p.x[c], dy = q.y[j] - p.y[c], dz = q.z[j] - p.z[c];
    float ex = 0, ey = 0, ez = 0, damp = 0;
    if (Damped) {
      ex = dx - (q0.x[j] - p0.x[c]);
      ey = dy - (q0.y[j] - p0.y[c]);
      ez = dz - (q0.z[j] - p0.z[c]);
      damp = per_step * damping[c];
    }
    const float s = pull<Damped>({dx, dy, dz}, {ex, ey, ez}, k[c], rest[c], damp);
    fx[c] = s * dx;
    fy[c] = s * dy;
    fz[c] = s * dz;
  }
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

inline void share_out(const SpringRun& run, Row3 force, Row3 here, Row3 there) {
  const int first = run.first, last = run.last, shift = run.shift;
  add(first, last, force.x, here.x);
  add(first, last, force.y, here.y);
  add(first, last, force.z, here.z);
  subtract(first, last, shift, force.x, there.x);
  subtract(first, last, shift, force.y, there.y);
  subtract(first, last, shift, force.z, there.z);
}

}  // namespace

void springs(const SpringRun& run, Row3 lines, Row3 out, Row3 out_there) {
  if (run.springs.damping == nullptr)
    spring_forces<false>(run, lines);
  else
    spring_forces<true>(run, lines);
  share_out(run, lines, out, out_there);
}

double spring_energy(const SpringRun& run) {
  const float* __restrict k = run.springs.stiffness;
  const float* __restrict rest = run.springs.rest_length;
  const ConstRow3 p = run.here.position, q = run.there.position;
  const int shift = run.shift;
  const auto energy = [&](int c) {
    const int j = c + shift;
    const float dx = q.x[j] - p.x[c], dy = q.y[j] - p.y[c], dz = q.z[j] - p.z[c];
    const float strained = __builtin_sqrtf(dx * dx + dy * dy + dz * dz) - rest[c];
    return 0.5F * k[c] * strained * strained;
  };
  alignas(64) float sums[lanes] = {};
  int c = run.first;
  for (; c + lanes <= run.last; c += lanes)
#pragma omp simd
    for (int lane = 0; lane < lanes; ++lane) sums[lane] += energy(c + lane);
  for (int lane = 0; c < run.last; ++c, ++lane) sums[lane] += energy(c);
  double sum = 0;
  for (int lane = 0; lane < lanes; ++lane) sum += double{sums[lane]};
  return sum;
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
