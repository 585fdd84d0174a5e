#include <cmath>

#include "weft/collide/kernels/isa/rows.h"

namespace weft::WEFT_KERNEL_SET {
namespace {

/// Margin by which the determinant has to be positive, against rounding.
constexpr float min_definite = 0.01F;
constexpr int planes = 12;

inline float absolute(float a) { return a < 0 ? -a : a; }
inline float centre(float lower, float upper) { return 0.5F * (lower + upper); }
inline float half(float lower, float upper, float slack) { return 0.5F * (upper - lower) + slack; }
inline bool is_lower(int plane) { return plane % 6 < 3; }

/// Minima and maxima of to - from over four rows.
void differences(int n, const float* const (&from)[4], const float* const (&to)[4],
                 float* __restrict lower, float* __restrict upper) {
  const float *a = from[0], *b = from[1], *c = from[2], *d = from[3];
  const float *e = to[0], *f = to[1], *g = to[2], *h = to[3];
#pragma omp simd
  for (int i = 0; i < n; ++i) {
    const float p = e[i] - a[i], q = f[i] - b[i], s = g[i] - c[i], t = h[i] - d[i];
    lower[i] = min(min(p, q), min(s, t));
    upper[i] = max(max(p, q), max(s, t));
  }
}

template <class Pick>
void join_neighbours(int n, const float* a, const float* b, float* __restrict out, Pick pick) {
#pragma omp simd
  for (int i = 0; i < n; ++i) out[i] = pick(pick(a[i], a[i + 1]), pick(b[i], b[i + 1]));
}

template <class Pick>
void join_pairs(int n, const float* a, const float* b, float* __restrict out, Pick pick) {
#pragma omp simd
  for (int i = 0; i < n; ++i)
    out[i] = pick(pick(a[2 * i], a[2 * i + 1]), pick(b[2 * i], b[2 * i + 1]));
}

}  // namespace

void edges(int n, const EdgeRows& rows, float* const* out) {
  const float *a = rows.start, *b = rows.next_start, *c = rows.end, *d = rows.next_end;
  differences(n, {a, b, c, d}, {a + 1, b + 1, c + 1, d + 1}, out[0], out[1]);
  differences(n, {a, a + 1, c, c + 1}, {b, b + 1, d, d + 1}, out[2], out[3]);
}

void join_windows(int n, const float* const* a, const float* const* b, float* const* out) {
  for (int k = 0; k < planes; ++k) {
    if (is_lower(k)) {
      join_neighbours(n, a[k], b[k], out[k], [](float p, float q) { return min(p, q); });
    } else {
      join_neighbours(n, a[k], b[k], out[k], [](float p, float q) { return max(p, q); });
    }
  }
}

void join_twos(int n, const float* const* a, const float* const* b, float* const* out) {
  for (int k = 0; k < planes; ++k) {
    if (is_lower(k)) {
      join_pairs(n, a[k], b[k], out[k], [](float p, float q) { return min(p, q); });
    } else {
      join_pairs(n, a[k], b[k], out[k], [](float p, float q) { return max(p, q); });
    }
  }
}

void find_unfolded(int n, const float* const* of, float slack, float* __restrict out) {
  const float *ax = of[0], *ay = of[1], *az = of[2], *bx = of[3], *by = of[4], *bz = of[5];
  const float *cx = of[6], *cy = of[7], *cz = of[8], *dx = of[9], *dy = of[10], *dz = of[11];
#pragma omp simd
  for (int i = 0; i < n; ++i) {
    const float ux = centre(ax[i], bx[i]), ux_off = half(ax[i], bx[i], slack);
    const float uy = centre(ay[i], by[i]), uy_off = half(ay[i], by[i], slack);
    const float uz = centre(az[i], bz[i]), uz_off = half(az[i], bz[i], slack);
    const float vx = centre(cx[i], dx[i]), vx_off = half(cx[i], dx[i], slack);
    const float vy = centre(cy[i], dy[i]), vy_off = half(cy[i], dy[i], slack);
    const float vz = centre(cz[i], dz[i]), vz_off = half(cz[i], dz[i], slack);
    const float uu = ux * ux + uy * uy + uz * uz;
    const float vv = vx * vx + vy * vy + vz * vz;
    const float uv = ux * vx + uy * vy + uz * vz;
    const float determinant = uu * vv - uv * uv;
    // If the determinant is 0, infinities and NaNs fail every comparison below.
    const float p = vv / determinant, q = uv / determinant, r = uu / determinant;
    const float px = p * ux - q * vx, py = p * uy - q * vy, pz = p * uz - q * vz;
    const float rx = r * vx - q * ux, ry = r * vy - q * uy, rz = r * vz - q * uz;
    const float first = 1 - (absolute(px) * ux_off + absolute(py) * uy_off + absolute(pz) * uz_off);
    const float second =
        1 - (absolute(rx) * vx_off + absolute(ry) * vy_off + absolute(rz) * vz_off);
    // Both directions are scaled to equal length, so that long and short sides count alike.
    const float scale = std::sqrt(uu / vv);
    const float mixed =
        0.5F * (scale * (absolute(px) * vx_off + absolute(py) * vy_off + absolute(pz) * vz_off) +
                (absolute(rx) * ux_off + absolute(ry) * uy_off + absolute(rz) * uz_off) / scale);
    const float definite = first * second - mixed * mixed - min_definite;
    out[i] = determinant > 0 && first > 0 && second > 0 && definite > 0 ? 1.0F : 0.0F;
  }
}

}  // namespace weft::WEFT_KERNEL_SET
