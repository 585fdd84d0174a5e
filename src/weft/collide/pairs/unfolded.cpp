#include "weft/collide/pairs/unfolded.h"

#include <array>
#include <cmath>

namespace weft {
namespace {

/// How far a dot product with `v` may be off its value at the centre.
double spread(Vec3d v, Vec3d half) {
  return std::abs(v.x) * half.x + std::abs(v.y) * half.y + std::abs(v.z) * half.z;
}

Vec3d half_extent(const Box3f& box, double slack) {
  const Vec3d half = 0.5 * (vec_cast<double>(box.upper) - vec_cast<double>(box.lower));
  return half + Vec3d{slack, slack, slack};
}

Vec3d centre(const Box3f& box) {
  return 0.5 * (vec_cast<double>(box.lower) + vec_cast<double>(box.upper));
}

/// Left of the positive determinant, against rounding.
constexpr double least_definite = 0.01;

inline float least(float a, float b) { return a < b ? a : b; }
inline float largest(float a, float b) { return a > b ? a : b; }
inline float absolute(float a) { return a < 0 ? -a : a; }

/// Six planes' two rows of cells.
struct TwoRows {
  std::array<const float*, 6> first, second;

  TwoRows(const ExtentLevels& levels, int row) : first(), second() {
    for (std::size_t k = 0; k < 6; ++k) {
      first[k] = levels.finest()[k].row(row);
      second[k] = levels.finest()[k].row(row + 1);
    }
  }
};

/// The window at a column: centre and half extent of a coordinate.
struct Middle {
  float centre, half;
};
inline Middle middle(const TwoRows& rows, int axis, int c, float slack) {
  const float *l = rows.first[axis], *m = rows.second[axis];
  const float *h = rows.first[axis + 3], *i = rows.second[axis + 3];
  const float lower = least(least(l[c], l[c + 1]), least(m[c], m[c + 1]));
  const float upper = largest(largest(h[c], h[c + 1]), largest(i[c], i[c + 1]));
  return {0.5F * (lower + upper), 0.5F * (upper - lower) + slack};
}

inline float spread(float x, float y, float z, const Middle& hx, const Middle& hy,
                    const Middle& hz) {
  return absolute(x) * hx.half + absolute(y) * hy.half + absolute(z) * hz.half;
}

}  // namespace

void find_unfolded_windows(const ExtentLevels& along_rows, const ExtentLevels& along_columns,
                           int row, float slack, float* out) {
  const TwoRows rows(along_rows, row), columns(along_columns, row);
  const int windows = along_rows.sides().front() - 1;
#pragma omp simd
  for (int c = 0; c < windows; ++c) {
    const Middle ux = middle(rows, 0, c, slack), uy = middle(rows, 1, c, slack),
                 uz = middle(rows, 2, c, slack);
    const Middle vx = middle(columns, 0, c, slack), vy = middle(columns, 1, c, slack),
                 vz = middle(columns, 2, c, slack);
    const float uu = ux.centre * ux.centre + uy.centre * uy.centre + uz.centre * uz.centre;
    const float vv = vx.centre * vx.centre + vy.centre * vy.centre + vz.centre * vz.centre;
    const float uv = ux.centre * vx.centre + uy.centre * vy.centre + uz.centre * vz.centre;
    const float determinant = uu * vv - uv * uv;
    // Where there is none, infinities and what is not a number fail every comparison below.
    const float p = vv / determinant, q = uv / determinant, r = uu / determinant;
    const float ax = p * ux.centre - q * vx.centre, ay = p * uy.centre - q * vy.centre,
                az = p * uz.centre - q * vz.centre;
    const float bx = r * vx.centre - q * ux.centre, by = r * vy.centre - q * uy.centre,
                bz = r * vz.centre - q * uz.centre;
    const float scale = std::sqrt(uu / vv);
    const float first = 1 - spread(ax, ay, az, ux, uy, uz);
    const float second = 1 - spread(bx, by, bz, vx, vy, vz);
    const float mixed =
        0.5F * (scale * spread(ax, ay, az, vx, vy, vz) + spread(bx, by, bz, ux, uy, uz) / scale);
    const float definite = first * second - mixed * mixed - static_cast<float>(least_definite);
    out[c] = determinant > 0 && first > 0 && second > 0 && definite > 0 ? 1.0F : 0.0F;
  }
}

bool certainly_unfolded(const Box3f& along_rows, const Box3f& along_columns, float slack) {
  const Vec3d u = centre(along_rows), v = centre(along_columns);
  const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v);
  const double determinant = uu * vv - uv * uv;
  if (!(determinant > 0)) return false;
  const Vec3d a = (1 / determinant) * (vv * u - uv * v), b = (1 / determinant) * (uu * v - uv * u);
  // Scaled alike, so that long and short sides count alike.
  const double scale = std::sqrt(std::sqrt(uu / vv));
  const Vec3d ru = half_extent(along_rows, slack), rv = half_extent(along_columns, slack);
  const double first = 1 - spread(a, ru), second = 1 - spread(b, rv);
  const double mixed = 0.5 * (scale * scale * spread(a, rv) + spread(b, ru) / (scale * scale));
  return first > 0 && second > 0 && first * second > mixed * mixed + least_definite;
}

}  // namespace weft
