#include "weft/mesh/shapes/field.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

constexpr int newton_steps = 12;
constexpr double close_enough = 1e-9;  // [m]

}  // namespace

double distance_to(const RoundCone& cone, Vec3d point) {
  const Vec3d axis = cone.b - cone.a, from_a = point - cone.a;
  const double axis_length = length(axis);
  const double along = dot(from_a, axis) / axis_length;
  const double beside = std::sqrt(std::max(0.0, squared_length(from_a) - along * along));
  const double slope = (cone.radius_a - cone.radius_b) / axis_length;
  // The ball nearest to the point: |point - centre(t)| - radius(t) is convex in t, and stationary
  // here.
  const double t =
      std::clamp(along - beside * slope / std::sqrt(1 - slope * slope), 0.0, axis_length);
  return std::sqrt(beside * beside + (along - t) * (along - t)) - (cone.radius_a - slope * t);
}

double distance_to(const Ellipsoid& ellipsoid, Vec3d point) {
  const Vec3d r = ellipsoid.radii, p = point - ellipsoid.centre;
  const Vec3d scaled{p.x / r.x, p.y / r.y, p.z / r.z};
  const double level = length(scaled);
  const double slope = length(Vec3d{scaled.x / r.x, scaled.y / r.y, scaled.z / r.z});
  if (slope == 0) return -std::min({r.x, r.y, r.z});
  return level * (level - 1) / slope;
}

Limb::Limb(std::span<const Joint> joints) {
  constexpr int pieces = 4;  // of each span
  const auto blend = [](double wa, const Joint& a, double wb, const Joint& b) {
    return Joint{wa * a.centre + wb * b.centre, wa * a.radius + wb * b.radius};
  };
  const int last = static_cast<int>(joints.size()) - 1;
  Joint before = joints[0];
  for (int i = 0; i < last; ++i) {
    const Joint &a = joints[i], &b = joints[i + 1];
    const Joint slope_a = blend(0.5, b, -0.5, joints[std::max(i - 1, 0)]);
    const Joint slope_b = blend(0.5, joints[std::min(i + 2, last)], -0.5, a);
    for (int piece = 1; piece <= pieces; ++piece) {
      const double t = static_cast<double>(piece) / pieces, rest = 1 - t;
      const Joint here = blend(1, blend(rest * rest * (1 + 2 * t), a, t * t * (1 + 2 * rest), b), 1,
                               blend(t * rest * rest, slope_a, -t * t * rest, slope_b));
      cones.push_back({before.centre, here.centre, before.radius, here.radius});
      before = here;
    }
  }
  for (const RoundCone& cone : cones) {
    const double radius = std::max(cone.radius_a, cone.radius_b);
    for (const Vec3d end : {cone.a, cone.b}) {
      box.add(end + Vec3d{radius, radius, radius});
      box.add(end - Vec3d{radius, radius, radius});
    }
  }
}

double distance_to(const Limb& limb, Vec3d point) {
  double least = HUGE_VAL;
  for (const RoundCone& cone : limb.cones) least = std::min(least, distance_to(cone, point));
  return least;
}

double distance_to(const Box3d& box, Vec3d point) {
  return length(max(max(box.lower - point, point - box.upper), Vec3d{}));
}

double smooth_min(double a, double b, double blend) {
  const double overlap = std::max(0.0, blend - std::abs(a - b));
  return std::min(a, b) - overlap * overlap / (4 * blend);
}

double smooth_max(double a, double b, double blend) { return -smooth_min(-a, -b, blend); }

Vec3d gradient(const Field& field, Vec3d point) {
  constexpr double step = 1e-4;
  const auto slope = [&](Vec3d d) { return (field(point + d) - field(point - d)) / (2 * step); };
  return {slope({step, 0, 0}), slope({0, step, 0}), slope({0, 0, step})};
}

Vec3d project_to_surface(const Field& field, Vec3d point) {
  for (int i = 0; i < newton_steps; ++i) {
    const double value = field(point);
    if (std::abs(value) < close_enough) break;
    const Vec3d slope = gradient(field, point);
    const double squared = squared_length(slope);
    if (squared == 0) break;
    point -= (value / squared) * slope;
  }
  return point;
}

Vec3d project_to_curve(const Field& first, const Field& second, Vec3d point) {
  for (int i = 0; i < newton_steps; ++i) {
    const double f = first(point), g = second(point);
    if (std::abs(f) < close_enough && std::abs(g) < close_enough) break;
    const Vec3d df = gradient(first, point), dg = gradient(second, point);
    // The shortest step that brings both to zero lies in the plane of the two gradients.
    const double ff = squared_length(df), fg = dot(df, dg), gg = squared_length(dg);
    const double determinant = ff * gg - fg * fg;
    if (determinant <= 1e-6 * ff * gg) break;
    point -= ((f * gg - g * fg) / determinant) * df + ((g * ff - f * fg) / determinant) * dg;
  }
  return point;
}

}  // namespace weft
