#include "weft/collide/contacts/closest.h"

#include <algorithm>

namespace weft {
namespace {

double share(double along, double whole) {
  return whole > 0 ? std::clamp(along / whole, 0.0, 1.0) : 0.0;
}

/// Parameters of the closest points of the segments p + s d and q + t e.
struct Parameters {
  double s = 0, t = 0;
};

Parameters closest_on_segments(Vec3d p, Vec3d d, Vec3d q, Vec3d e) {
  const Vec3d r = p - q;
  const double dd = dot(d, d), ee = dot(e, e), de = dot(d, e), dr = dot(d, r), er = dot(e, r);
  const double determinant = dd * ee - de * de;
  // Nearly parallel segments have many closest pairs; clamping t below finds one of them.
  constexpr double parallel = 1e-12;
  double s = determinant > parallel * dd * ee
                 ? std::clamp((de * er - dr * ee) / determinant, 0.0, 1.0)
                 : 0.0;
  const double t = share(de * s + er, ee);
  s = share(de * t - dr, dd);
  return {s, t};
}

Vec3d weighted(const std::array<Vec3d, 3>& corners, const std::array<double, 3>& w) {
  return w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2];
}

void keep_closer(const ClosestPair& found, ClosestPair& best) {
  if (found.squared_distance < best.squared_distance) best = found;
}

void try_edges(const Feature& a, const Feature& b, ClosestPair& best) {
  const int edges_a = a.count == 3 ? 3 : a.count - 1, edges_b = b.count == 3 ? 3 : b.count - 1;
  for (int i = 0; i < edges_a; ++i)
    for (int j = 0; j < edges_b; ++j) {
      const int i1 = (i + 1) % a.count, j1 = (j + 1) % b.count;
      const Vec3d d = a.corners[i1] - a.corners[i], e = b.corners[j1] - b.corners[j];
      const auto [s, t] = closest_on_segments(a.corners[i], d, b.corners[j], e);
      ClosestPair found;
      found.weights_a[i] = 1 - s;
      found.weights_a[i1] = s;
      found.weights_b[j] = 1 - t;
      found.weights_b[j1] = t;
      found.a = a.corners[i] + s * d;
      found.b = b.corners[j] + t * e;
      found.squared_distance = squared_length(found.a - found.b);
      keep_closer(found, best);
    }
}

/// Every corner of `a` with the triangle `b`.
void try_corners(const Feature& a, const Feature& b, ClosestPair& best, bool swapped) {
  for (int i = 0; i < a.count; ++i) {
    ClosestPair found;
    std::array<double, 3>& own = swapped ? found.weights_b : found.weights_a;
    std::array<double, 3>& other = swapped ? found.weights_a : found.weights_b;
    own[i] = 1;
    other = closest_weights(a.corners[i], b.corners);
    const Vec3d on_triangle = weighted(b.corners, other);
    found.a = swapped ? on_triangle : a.corners[i];
    found.b = swapped ? a.corners[i] : on_triangle;
    found.squared_distance = squared_length(found.a - found.b);
    keep_closer(found, best);
  }
}

}  // namespace

std::array<Vec3d, 3> corners_at(const Planes3& positions, const std::array<int, 3>& samples) {
  return {vec_cast<double>(positions.at(samples[0])), vec_cast<double>(positions.at(samples[1])),
          vec_cast<double>(positions.at(samples[2]))};
}

Vec3d blend(const std::array<Vec3d, 3>& corners, const std::array<double, 3>& w) {
  return w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2];
}

std::array<double, 3> closest_weights(Vec3d p, const std::array<Vec3d, 3>& triangle) {
  const auto& [a, b, c] = triangle;
  const Vec3d ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const Vec3d bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double t = share(d1, d1 - d3);
    return {1 - t, t, 0};
  }
  const Vec3d cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double t = share(d2, d2 - d6);
    return {1 - t, 0, t};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double t = share(d4 - d3, (d4 - d3) + (d5 - d6));
    return {0, 1 - t, t};
  }
  const double sum = va + vb + vc;
  if (!(sum > 0)) return {1, 0, 0};  // no area, and rounding hid which edge is meant
  return {va / sum, vb / sum, vc / sum};
}

ClosestPair closest_points(const Feature& a, const Feature& b) {
  ClosestPair best;
  if (b.count == 3) try_corners(a, b, best, false);
  if (a.count == 3) try_corners(b, a, best, true);
  try_edges(a, b, best);
  return best;
}

}  // namespace weft
