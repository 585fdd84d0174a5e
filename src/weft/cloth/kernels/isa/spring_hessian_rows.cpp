#include <cmath>

#include "weft/cloth/kernels/isa/rows.h"

namespace weft::WEFT_KERNEL_SET {
namespace {

/// Lower bound of a spring's squared length, which keeps its direction finite. [m^2]
constexpr float min_squared_length = 1e-24F;
/// Number of lanes in which energies are summed, whatever the vector's width.
constexpr int lanes = 16;

inline float larger(float a, float b) { return a > b ? a : b; }

struct Sum6 {
  float xx, xy, xz, yy, yz, zz;
};

inline Sum6 operator+(const Sum6& a, const Sum6& b) {
  return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yy + b.yy, a.yz + b.yz, a.zz + b.zz};
}

/// Writes sum + t 1 as a block.
inline void put(const Sum6& sum, float t, float* const* entry, int c) {
  entry[0][c] = sum.xx + t;
  entry[1][c] = sum.xy;
  entry[2][c] = sum.xz;
  entry[3][c] = sum.yy + t;
  entry[4][c] = sum.yz;
  entry[5][c] = sum.zz + t;
}

/// g -= f (x_j - x_i)
inline void pull(const ConstSpringHessianRow& spring, int c, float dx, float dy, float dz,
                 float& gx, float& gy, float& gz) {
  const float f = spring.f[c];
  gx -= f * dx;
  gy -= f * dy;
  gz -= f * dz;
}

/// t += the spring's t; sum += s s^T
inline void stiffen(const ConstSpringHessianRow& spring, int c, float& t, Sum6& sum) {
  const float x = spring.x[c], y = spring.y[c], z = spring.z[c];
  t += spring.t[c];
  sum.xx += x * x;
  sum.xy += x * y;
  sum.xz += x * z;
  sum.yy += y * y;
  sum.yz += y * z;
  sum.zz += z * z;
}

struct Force {
  float x, y, z;
};

/// (t + s s^T) (x_i - x_j): differences first, so that nothing cancels.
inline Force resist(const ConstSpringHessianRow& spring, int c, float dx, float dy, float dz) {
  const float x = spring.x[c], y = spring.y[c], z = spring.z[c], t = spring.t[c];
  const float along = x * dx + y * dy + z * dz;
  return {t * dx + along * x, t * dy + along * y, t * dz + along * z};
}

}  // namespace

void linearise(int n, const LinearisedSprings& in, SpringHessianRow out) {
  const float *rest = in.rest_length, *stiffness = in.stiffness, *damping = in.damping;
  const ConstRow3 a = in.here, b = in.there, va = in.speed_here, vb = in.speed_there,
                  oa = in.start_here, ob = in.start_there;
  const float per_step = in.per_step, limit = in.limit, limit_factor = in.limit_factor,
              guessed_share = in.guessed_share;
  float *t = out.t, *sx = out.x, *sy = out.y, *sz = out.z, *f = out.f;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    const float x = b.x[c] - a.x[c], y = b.y[c] - a.y[c], z = b.z[c] - a.z[c];
    const float squared = larger(x * x + y * y + z * z, min_squared_length);
    const float inverse = 1 / std::sqrt(squared);
    const float ratio = rest[c] * inverse, k = stiffness[c];
    const float over = 1 - limit * ratio;
    const float stiffer = over > 0 ? limit_factor * k : 0.0F;
    const float tension = k * (1 - ratio) + stiffer * over;
    const float ox = ob.x[c] - oa.x[c], oy = ob.y[c] - oa.y[c], oz = ob.z[c] - oa.z[c];
    const float squared_before = larger(ox * ox + oy * oy + oz * oz, min_squared_length);
    const float held = k * (1 - rest[c] / std::sqrt(squared_before));
    const float across = larger(larger(held, guessed_share * tension), 0.0F);
    const float approach =
        x * (vb.x[c] - va.x[c]) + y * (vb.y[c] - va.y[c]) + z * (vb.z[c] - va.z[c]);
    const float axial = larger(k + stiffer + damping[c] * per_step - across, 0.0F);
    const float s = std::sqrt(axial) * inverse;
    f[c] = tension + damping[c] * approach * (inverse * inverse);
    t[c] = across;
    sx[c] = s * x;
    sy[c] = s * y;
    sz[c] = s * z;
  }
}

void gradient(int n, const SpringRing& ring, const RowTriple& x, const float* mass, ConstRow3 speed,
              ConstRow3 wanted, Row3 out) {
  const auto* s = ring.spring;
  const ConstRow3 above = x.above, here = x.here, below = x.below;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    const float hx = here.x[c], hy = here.y[c], hz = here.z[c];
    float gx = mass[c] * (speed.x[c] - wanted.x[c]), gy = mass[c] * (speed.y[c] - wanted.y[c]),
          gz = mass[c] * (speed.z[c] - wanted.z[c]);
    pull(s[0], c, here.x[c + 1] - hx, here.y[c + 1] - hy, here.z[c + 1] - hz, gx, gy, gz);
    pull(s[1], c, here.x[c - 1] - hx, here.y[c - 1] - hy, here.z[c - 1] - hz, gx, gy, gz);
    pull(s[2], c, below.x[c] - hx, below.y[c] - hy, below.z[c] - hz, gx, gy, gz);
    pull(s[3], c, above.x[c] - hx, above.y[c] - hy, above.z[c] - hz, gx, gy, gz);
    pull(s[4], c, below.x[c + 1] - hx, below.y[c + 1] - hy, below.z[c + 1] - hz, gx, gy, gz);
    pull(s[5], c, above.x[c - 1] - hx, above.y[c - 1] - hy, above.z[c - 1] - hz, gx, gy, gz);
    pull(s[6], c, below.x[c - 1] - hx, below.y[c - 1] - hy, below.z[c - 1] - hz, gx, gy, gz);
    pull(s[7], c, above.x[c + 1] - hx, above.y[c + 1] - hy, above.z[c + 1] - hz, gx, gy, gz);
    out.x[c] = gx;
    out.y[c] = gy;
    out.z[c] = gz;
  }
}

void diagonal(int n, const SpringRing& ring, const float* mass, MutableBlockRow6 out) {
  const auto* s = ring.spring;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    float t = mass[c];
    Sum6 sum{0, 0, 0, 0, 0, 0};
    stiffen(s[0], c, t, sum);
    stiffen(s[1], c, t, sum);
    stiffen(s[2], c, t, sum);
    stiffen(s[3], c, t, sum);
    stiffen(s[4], c, t, sum);
    stiffen(s[5], c, t, sum);
    stiffen(s[6], c, t, sum);
    stiffen(s[7], c, t, sum);
    put(sum, t, out.entry, c);
  }
}

void line_diagonals(int n, const SpringRing& ring, const float* mass, const float* extra,
                    const LineDiagonals& out) {
  const auto* s = ring.spring;
  float *const *whole = out.whole.entry, *const *rows = out.rows.entry,
               *const *cols = out.cols.entry;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    float t = mass[c];
    Sum6 shared{0, 0, 0, 0, 0, 0};
    stiffen(s[4], c, t, shared);
    stiffen(s[5], c, t, shared);
    stiffen(s[6], c, t, shared);
    stiffen(s[7], c, t, shared);
    float along = 0, across = 0;
    Sum6 row{0, 0, 0, 0, 0, 0}, col{0, 0, 0, 0, 0, 0};
    stiffen(s[0], c, along, row);
    stiffen(s[1], c, along, row);
    stiffen(s[2], c, across, col);
    stiffen(s[3], c, across, col);
    const float in_row = t + extra[c] + across, in_col = t + extra[c] + along,
                all = t + along + across;
    put(shared + col, in_row, rows, c);
    put(shared + row, in_col, cols, c);
    put(shared + row + col, all, whole, c);
  }
}

void apply_springs(int n, const ConstSpringHessianRow* springs, const SpringSweep& at, Row3 out) {
  const ConstRow3 here = at.here, below = at.below, carried = at.carried;
  const Row3 right = at.right, below_right = at.below_right, below_left = at.below_left,
             carry = at.carry;
  const float* mass = at.mass;
  const ConstSpringHessianRow to_right = springs[0], down = springs[1], to_below_right = springs[2],
                              to_below_left = springs[3];
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    const float hx = here.x[c], hy = here.y[c], hz = here.z[c];
    const Force r = resist(to_right, c, hx - here.x[c + 1], hy - here.y[c + 1], hz - here.z[c + 1]);
    const Force d = resist(down, c, hx - below.x[c], hy - below.y[c], hz - below.z[c]);
    const Force a =
        resist(to_below_right, c, hx - below.x[c + 1], hy - below.y[c + 1], hz - below.z[c + 1]);
    const Force b =
        resist(to_below_left, c, hx - below.x[c - 1], hy - below.y[c - 1], hz - below.z[c - 1]);
    out.x[c] = mass[c] * hx + (r.x + d.x) + (a.x + b.x) + carried.x[c];
    out.y[c] = mass[c] * hy + (r.y + d.y) + (a.y + b.y) + carried.y[c];
    out.z[c] = mass[c] * hz + (r.z + d.z) + (a.z + b.z) + carried.z[c];
    right.x[c] = r.x;
    right.y[c] = r.y;
    right.z[c] = r.z;
    carry.x[c] = d.x;
    carry.y[c] = d.y;
    carry.z[c] = d.z;
    below_right.x[c] = a.x;
    below_right.y[c] = a.y;
    below_right.z[c] = a.z;
    below_left.x[c] = b.x;
    below_left.y[c] = b.y;
    below_left.z[c] = b.z;
  }
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    out.x[c] -= right.x[c - 1];
    out.y[c] -= right.y[c - 1];
    out.z[c] -= right.z[c - 1];
    carry.x[c] = -(carry.x[c] + below_right.x[c - 1] + below_left.x[c + 1]);
    carry.y[c] = -(carry.y[c] + below_right.y[c - 1] + below_left.y[c + 1]);
    carry.z[c] = -(carry.z[c] + below_right.z[c - 1] + below_left.z[c + 1]);
  }
}

double spring_energy(int n, const LinearisedSprings& in) {
  const float *rest = in.rest_length, *stiffness = in.stiffness, *damping = in.damping;
  const ConstRow3 a = in.here, b = in.there, va = in.speed_here, vb = in.speed_there;
  const float limit = in.limit, limit_factor = in.limit_factor, step = in.step;
  const auto energy = [=](int c) __attribute__((always_inline)) {
    const float x = b.x[c] - a.x[c], y = b.y[c] - a.y[c], z = b.z[c] - a.z[c];
    const float squared = larger(x * x + y * y + z * z, min_squared_length);
    const float length = std::sqrt(squared);
    const float elongation = length - rest[c], over = larger(length - limit * rest[c], 0.0F);
    const float approach =
        x * (vb.x[c] - va.x[c]) + y * (vb.y[c] - va.y[c]) + z * (vb.z[c] - va.z[c]);
    return 0.5F * (stiffness[c] * (elongation * elongation + limit_factor * (over * over)) +
                   step * damping[c] * (approach * approach) / squared);
  };
  alignas(64) float sums[lanes] = {};
  int c = 0;
  for (; c + lanes <= n; c += lanes)
#pragma omp simd
    for (int lane = 0; lane < lanes; ++lane) sums[lane] += energy(c + lane);
  for (int lane = 0; c < n; ++c, ++lane) sums[lane] += energy(c);
  double sum = 0;
  for (const float lane : sums) sum += double{lane};
  return sum;
}

void spring_blocks(int n, ConstSpringHessianRow spring, const float* mask, const float* other,
                   MutableBlockRow6 out) {
  const float *t = spring.t, *x = spring.x, *y = spring.y, *z = spring.z;
  float *xx = out.entry[0], *xy = out.entry[1], *xz = out.entry[2], *yy = out.entry[3],
        *yz = out.entry[4], *zz = out.entry[5];
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    const float k = -mask[c] * other[c];
    xx[c] = k * (t[c] + x[c] * x[c]);
    xy[c] = k * (x[c] * y[c]);
    xz[c] = k * (x[c] * z[c]);
    yy[c] = k * (t[c] + y[c] * y[c]);
    yz[c] = k * (y[c] * z[c]);
    zz[c] = k * (t[c] + z[c] * z[c]);
  }
}

}  // namespace weft::WEFT_KERNEL_SET
