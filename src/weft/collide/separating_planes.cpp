#include "weft/collide/separating_planes.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

/// Rounding of positions in single precision, relative to their size, times a few: kept free on
/// either side of a plane.
constexpr double rounding = 1e-6;
/// Of the gap at the start, between cloths on either side of the plane, before a body on one: what
/// is no wider than the margins may hardly shrink, lest it vanish within a few steps.
constexpr double most_margin = 0.4999, most_margin_before_body = 0.9998;

double least_along(Vec3d n, const std::array<Vec3d, 3>& corners, int count) {
  double least = dot(n, corners[0]);
  for (int i = 1; i < count; ++i) least = std::min(least, dot(n, corners[i]));
  return least;
}
double most_along(Vec3d n, const std::array<Vec3d, 3>& corners, int count) {
  return -least_along(-n, corners, count);
}

/// Gaps along a direction at both ends of the step.
struct Gaps {
  double start, end;
};
Gaps gaps_along(Vec3d n, const MovingFeature& a, const MovingFeature& b) {
  return {least_along(n, a.start, a.count) - most_along(n, b.start, b.count),
          least_along(n, a.end, a.count) - most_along(n, b.end, b.count)};
}

Vec3d face_normal(const MovingFeature& of) {
  return normalized(cross(of.start[1] - of.start[0], of.start[2] - of.start[0]));
}

/// Whether a face's own direction, either way, keeps the two apart by the gaps that are wanted.
bool certain_along_face(const MovingFeature& face, const MovingFeature& a, const MovingFeature& b,
                        double wanted) {
  if (face.count < 3) return false;
  const Vec3d n = face_normal(face);
  const auto enough = [&](Gaps gaps) { return gaps.start > 0 && gaps.end >= wanted; };
  return n != Vec3d{} && (enough(gaps_along(n, a, b)) || enough(gaps_along(-n, a, b)));
}

void put_points(const MovingFeature& a, const MovingFeature& b, SeparatingPlane& plane) {
  plane.count_a = a.body ? 0 : a.count;
  plane.count_b = b.body ? 0 : b.count;
  std::copy_n(a.points.begin(), plane.count_a, plane.points.begin());
  std::copy_n(b.points.begin(), plane.count_b, plane.points.begin() + plane.count_a);
}

/// Where the plane stands: in the middle between two cloths, at the body's surface before one.
void put_offsets(const MovingFeature& a, const MovingFeature& b, SeparatingPlane& plane) {
  const Vec3d n = plane.normal;
  const double a_start = least_along(n, a.start, a.count),
               b_start = most_along(n, b.start, b.count);
  const double a_end = least_along(n, a.end, a.count), b_end = most_along(n, b.end, b.count);
  const double size = std::max(std::abs(a_start), std::abs(b_start));
  const double most = b.body ? most_margin_before_body : most_margin;
  const double margin = std::min(rounding * (1 + size), most * (a_start - b_start));
  const double still = b.body ? b_end : 0.5 * (a_start + b_start);
  const double moving = b.body ? b_end : 0.5 * (a_end + b_end);
  plane.offset_a = moving + margin;
  plane.offset_b = moving - margin;
  plane.still_a = still + margin;
  plane.still_b = still - margin;
}

}  // namespace

Separation separate(const MovingFeature& a, const MovingFeature& b, const PlaneOptions& options,
                    SeparatingPlane& out) {
  const double wanted = (b.body ? 1 : 2) * options.slack;
  if (certain_along_face(b, a, b, wanted) || certain_along_face(a, a, b, wanted))
    return Separation::certain;
  const ClosestPair closest = closest_points({a.start, a.count}, {b.start, b.count});
  out.normal = normalized(closest.a - closest.b);
  const Gaps gaps = gaps_along(out.normal, a, b);
  if (!(gaps.start > 0)) return Separation::meeting;
  if (gaps.end >= wanted) return Separation::certain;
  put_points(a, b, out);
  put_offsets(a, b, out);
  return Separation::plane;
}

}  // namespace weft
