#include "weft/cloth/kernels/isa/rows.h"

namespace weft::WEFT_KERNEL_SET {
namespace {

/// Lower bound of a spring's squared length, which keeps its force finite. [m^2]
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
namespace {

/// Sums have this many lanes whatever the vector's width, so that they round alike.
constexpr int lanes = 16;

/// Adds the columns first .. first + count - 1, each to its own lane.
inline __attribute__((always_inline)) void add_columns(const MomentRow& row, int first, int count,
                                                       float (*s)[lanes]) {
  const ConstRow3 position = row.position, a = row.acceleration;
  const float ox = row.about[0], oy = row.about[1], oz = row.about[2];
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const int c = first + i;
    const float m = row.mass[c] * row.owner[c];
    const float x = position.x[c] - ox, y = position.y[c] - oy, z = position.z[c] - oz;
    const float mx = m * x, my = m * y, mz = m * z;
    const float fx = m * a.x[c], fy = m * a.y[c], fz = m * a.z[c];
    s[0][i] += m;
    s[1][i] += mx;
    s[2][i] += my;
    s[3][i] += mz;
    s[4][i] += fx;
    s[5][i] += fy;
    s[6][i] += fz;
    s[7][i] += y * fz - z * fy;
    s[8][i] += z * fx - x * fz;
    s[9][i] += x * fy - y * fx;
    s[10][i] += mx * x;
    s[11][i] += my * y;
    s[12][i] += mz * z;
    s[13][i] += mx * y;
    s[14][i] += mx * z;
    s[15][i] += my * z;
  }
}

}  // namespace

void moments(int n, const MomentRow& row, double* sums) {
  float lane_sums[moment_terms][lanes] = {};
  int c = 0;
  for (; c + lanes <= n; c += lanes) add_columns(row, c, lanes, lane_sums);
  add_columns(row, c, n - c, lane_sums);
  for (int i = 0; i < moment_terms; ++i)
    for (const float lane : lane_sums[i]) sums[i] += double{lane};
}
namespace {

inline float folded(float* sums) {
  for (int half = lanes / 2; half > 0; half /= 2)
    for (int i = 0; i < half; ++i) sums[i] += sums[i + half];
  return sums[0];
}

/// Multiplies `Together` rows of the matrix at once, so that the vectors are read once for all.
template <int Together>
inline __attribute__((always_inline)) void rows_times(const float* matrix, std::ptrdiff_t stride,
                                                      ConstRow3 v, int first, Row3 out) {
  float sx[Together][lanes] = {}, sy[Together][lanes] = {}, sz[Together][lanes] = {};
  for (std::ptrdiff_t j = 0; j < stride; j += lanes)
    for (int r = 0; r < Together; ++r) {
      const float* row = matrix + (first + r) * stride + j;
#pragma omp simd
      for (int i = 0; i < lanes; ++i) {
        sx[r][i] += row[i] * v.x[j + i];
        sy[r][i] += row[i] * v.y[j + i];
        sz[r][i] += row[i] * v.z[j + i];
      }
    }
  for (int r = 0; r < Together; ++r) {
    out.x[first + r] = folded(sx[r]);
    out.y[first + r] = folded(sy[r]);
    out.z[first + r] = folded(sz[r]);
  }
}

}  // namespace

void dense_rows(int first, int last, const DenseMatrix& matrix, ConstRow3 vectors, Row3 out) {
  int r = first;
  for (; r + 2 <= last; r += 2) rows_times<2>(matrix.data, matrix.stride, vectors, r, out);
  if (r < last) rows_times<1>(matrix.data, matrix.stride, vectors, r, out);
}

}  // namespace weft::WEFT_KERNEL_SET
