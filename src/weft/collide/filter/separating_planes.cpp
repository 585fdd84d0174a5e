#include "weft/collide/filter/separating_planes.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

/// Margin kept free on either side of a plane: a few times the rounding of positions in single
/// precision, relative to their size.
constexpr double margin_of_size = 1e-6;
/// Largest margins relative to the gap at the start: between cloths on either side of the plane,
/// before a body on one. A gap no wider than the margins may hardly shrink, so that it does not
/// vanish within a few steps.
constexpr double max_margin = 0.4999, max_margin_before_body = 0.9998;

/// A plane that would have to turn farther stays as it is.
constexpr double min_cosine = 0.5;

using FeaturePlaces = std::array<Vec3d, 3> MovingFeature::*;

double min_along(Vec3d n, const std::array<Vec3d, 3>& corners, int count) {
  double min = dot(n, corners[0]);
  for (int i = 1; i < count; ++i) min = std::min(min, dot(n, corners[i]));
  return min;
}
double max_along(Vec3d n, const std::array<Vec3d, 3>& corners, int count) {
  return -min_along(-n, corners, count);
}

/// Gaps along a direction at both ends of the step.
struct Gaps {
  double start, end;
};
Gaps gaps_along(Vec3d n, const MovingFeature& a, const MovingFeature& b) {
  return {min_along(n, a.start, a.count) - max_along(n, b.start, b.count),
          min_along(n, a.end, a.count) - max_along(n, b.end, b.count)};
}

Vec3d face_normal(const MovingFeature& of) {
  return normalized(cross(of.start[1] - of.start[0], of.start[2] - of.start[0]));
}

/// Whether a face's normal, in either direction, separates two features by the gap that is wanted.
bool certain_along_face(const MovingFeature& face, const MovingFeature& a, const MovingFeature& b,
                        double wanted) {
  if (face.count < 3) return false;
  const Vec3d n = face_normal(face);
  const auto enough = [&](Gaps gaps) { return gaps.start > 0 && gaps.end >= wanted; };
  return n != Vec3d{} && (enough(gaps_along(n, a, b)) || enough(gaps_along(-n, a, b)));
}

Vec3d middle_of(const std::array<Vec3d, 3>& corners, int count) {
  Vec3d sum;
  for (int i = 0; i < count; ++i) sum += corners[i];
  return (1.0 / count) * sum;
}

/// The same for a body's face that slides past: along its normal interpolated to the time at which
/// it passes the feature.
bool certain_where_passed(const MovingFeature& a, const MovingFeature& body, double wanted) {
  if (body.count < 3 || body.start == body.end) return false;
  const Vec3d from = middle_of(body.start, body.count), to = middle_of(body.end, body.count);
  const double distance = squared_length(to - from);
  if (!(distance > 0)) return false;
  const double t =
      std::clamp(dot(middle_of(a.start, a.count) - from, to - from) / distance, 0.0, 1.0);
  const Vec3d turned = normalized(cross(body.end[1] - body.end[0], body.end[2] - body.end[0]));
  const Vec3d n = normalized((1 - t) * face_normal(body) + t * turned);
  const auto enough = [&](Gaps gaps) { return gaps.start > 0 && gaps.end >= wanted; };
  return n != Vec3d{} && (enough(gaps_along(n, a, body)) || enough(gaps_along(-n, a, body)));
}

void put_points(const MovingFeature& a, const MovingFeature& b, SeparatingPlane& plane) {
  plane.count_a = a.body ? 0 : a.count;
  plane.count_b = b.body ? 0 : b.count;
  std::copy_n(a.points.begin(), plane.count_a, plane.points.begin());
  std::copy_n(b.points.begin(), plane.count_b, plane.points.begin() + plane.count_a);
}

void put_closest(const MovingFeature& b, const ClosestPair& closest, SeparatingPlane& plane) {
  for (int k = 0; k < plane.count_a; ++k)
    plane.weights[k] = static_cast<float>(closest.weights_a[k]);
  for (int k = 0; k < plane.count_b; ++k)
    plane.weights[plane.count_a + k] = static_cast<float>(closest.weights_b[k]);
  if (!b.body) return;
  plane.body_point = closest.b;
  plane.body_point_displacement = {};
  for (int k = 0; k < b.count; ++k)
    plane.body_point_displacement += closest.weights_b[k] * (b.end[k] - b.start[k]);
}

/// Extents of two features towards each other along a direction. [m]
struct Reaches {
  double a, b;
  [[nodiscard]] double middle() const { return 0.5 * (a + b); }
};
Reaches reaches(Vec3d n, const MovingFeature& a, const MovingFeature& b, FeaturePlaces places) {
  return {min_along(n, a.*places, a.count), max_along(n, b.*places, b.count)};
}

/// Margin on either side of a plane between features with these extents. [m]
double margin_for(const MovingFeature& b, Reaches near) {
  const double size = std::max(std::abs(near.a), std::abs(near.b));
  const double max = b.body ? max_margin_before_body : max_margin;
  return std::min(margin_of_size * (1 + size), max * std::max(0.0, near.a - near.b));
}

/// Levels of a plane: in the middle between two cloths, at the surface before a body.
PlaneLevels levels_between(const MovingFeature& b, Reaches reached, double margin) {
  const double at = b.body ? reached.b : reached.middle();
  return {at + margin, at - margin};
}

void put_levels(const MovingFeature& a, const MovingFeature& b, SeparatingPlane& plane) {
  double margin = margin_for(b, reaches(plane.normal, a, b, &MovingFeature::start));
  const Reaches safe_positions = reaches(plane.turned, a, b, &MovingFeature::safe_position);
  if (plane.turns) margin = std::min(margin, margin_for(b, safe_positions));
  plane.at_end = levels_between(b, reaches(plane.turned, a, b, &MovingFeature::end), margin);
  plane.still = b.body ? plane.at_end : levels_between(b, safe_positions, margin);
}

/// Extents of twice the middle Bernstein coefficients along a plane that turns, of two features
/// that move to these places.
Reaches halfway_reaches(const SeparatingPlane& plane, const MovingFeature& a,
                        const MovingFeature& b, FeaturePlaces places) {
  const auto along = [&](const MovingFeature& of, int k) {
    return dot(plane.normal, (of.*places)[k]) + dot(plane.turned, of.start[k]);
  };
  Reaches found{HUGE_VAL, -HUGE_VAL};
  for (int k = 0; k < a.count; ++k) found.a = std::min(found.a, along(a, k));
  for (int k = 0; k < b.count; ++k) found.b = std::max(found.b, along(b, k));
  return found;
}

/// The direction between the closest points of two features at these places; where it turns too far
/// from the plane's normal, that.
Vec3d turned_normal(const SeparatingPlane& plane, const MovingFeature& a, const MovingFeature& b,
                    FeaturePlaces places) {
  const ClosestPair closest = closest_points({a.*places, a.count}, {b.*places, b.count});
  const Vec3d turned = normalized(closest.a - closest.b);
  return dot(turned, plane.normal) > min_cosine ? turned : plane.normal;
}

/// Turns a plane as the direction between the closest points turns from the start to the safe
/// positions, and places it between these. It is not fitted to the proposed ends: where planes turn
/// to safe positions there is no room to be shared anew.
void turn_to_safe_positions(const MovingFeature& a, const MovingFeature& b,
                            SeparatingPlane& plane) {
  plane.turned = turned_normal(plane, a, b, &MovingFeature::safe_position);
  if (plane.turned == plane.normal) return;
  plane.turns = true;
  put_levels(a, b, plane);
  plane.at_end = plane.still;
  const Reaches halfway = halfway_reaches(plane, a, b, &MovingFeature::safe_position);
  plane.halfway = levels_between(b, halfway, margin_for(b, halfway));
}

/// Whether two features that end at these extents are on their sides of these levels.
bool heed(Reaches reached, PlaneLevels levels) {
  return reached.a >= levels.a && reached.b <= levels.b;
}

/// Lets a plane that the proposed ends do not heed turn with them, if they do so without meeting:
/// as parts of a layer do that swings by more than lies between them.
void turn_to_ends(const MovingFeature& a, const MovingFeature& b, SeparatingPlane& plane) {
  if (heed(reaches(plane.normal, a, b, &MovingFeature::end), plane.at_end)) return;
  SeparatingPlane turning = plane;
  turning.turned = turned_normal(plane, a, b, &MovingFeature::end);
  const double margin = margin_for(b, reaches(plane.normal, a, b, &MovingFeature::start));
  const Reaches ends = reaches(turning.turned, a, b, &MovingFeature::end),
                halfway = halfway_reaches(turning, a, b, &MovingFeature::end);
  turning.at_end = levels_between(b, ends, margin);
  turning.halfway = levels_between(b, halfway, 2 * margin);
  turning.straight = plane.at_end;
  turning.turns = turning.follows_ends = true;
  if (heed(ends, turning.at_end) && heed(halfway, turning.halfway)) plane = turning;
}

}  // namespace

void straighten(SeparatingPlane& plane) {
  plane.turned = plane.normal;
  plane.at_end = plane.straight;
  plane.halfway = {-HUGE_VAL, HUGE_VAL};
  plane.follows_ends = false;
}

Separation separate(const MovingFeature& a, const MovingFeature& b, const PlaneOptions& options,
                    SeparatingPlane& out) {
  const double wanted = (b.body ? 1 : 2) * options.slack;
  if (certain_along_face(b, a, b, wanted) || certain_along_face(a, a, b, wanted))
    return Separation::certain;
  if (b.body && certain_where_passed(a, b, wanted)) return Separation::certain;
  const ClosestPair closest = closest_points({a.start, a.count}, {b.start, b.count});
  out.normal = normalized(closest.a - closest.b);
  const Gaps gaps = gaps_along(out.normal, a, b);
  if (!(gaps.start > 0)) return Separation::meeting;
  if (gaps.end >= wanted) return Separation::certain;
  put_points(a, b, out);
  put_closest(b, closest, out);
  out.turned = out.normal;
  put_levels(a, b, out);
  if (options.turn)
    turn_to_safe_positions(a, b, out);
  else
    turn_to_ends(a, b, out);
  if (b.body)
    out.body_displacement =
        max_along(out.turned, b.end, b.count) - max_along(out.turned, b.start, b.count);
  return Separation::plane;
}

}  // namespace weft
