#include "weft/collide/unfolded.h"

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

}  // namespace

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
