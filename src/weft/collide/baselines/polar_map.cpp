#include "weft/collide/baselines/polar_map.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace weft {
namespace {

/// Deepest push of the walking method, in sides of the body's cube: particles that lie deeper did
/// not get there in a step.
constexpr double deepest_push = 0.1;
/// Depth behind an open surface (in sides), besides the particle's displacement in the step, up to
/// which it counts as pressed through. An open surface has no inside: particles farther behind hang
/// there rightly.
constexpr double open_depth = 0.02;
/// Distance (in sides) below which the direction to the closest point is rounding, so that the
/// surface's normal serves.
constexpr double touching = 1e-5;
/// Rays are turned by this [rad], in no special direction, so that symmetric scenes do not send
/// them exactly through samples, where rounding would count the surface twice or not at all.
constexpr Vec3d nudge{0.53e-6, 0.31e-6, -0.79e-6};

double longest_side(const Box3d& box) {
  const Vec3d extent = box.extent();
  return std::max({extent.x, extent.y, extent.z, 1e-9});
}

/// On which side of the plane through the origin and the edge a-b a direction lies. The sign for
/// b-a is exactly the opposite, and a direction in the plane belongs to one side only: so a ray
/// through an edge that two triangles share meets one of them.
bool left_of_edge(Vec3d direction, Vec3d a, Vec3d b, bool ascending) {
  const double side = ascending ? dot(cross(a, b), direction) : dot(cross(b, a), direction);
  return (side >= 0) == ascending;
}

/// Distance along the ray from the origin at which it meets a triangle; negative where it does not.
double ray_distance(Vec3d direction, const std::array<Vec3d, 3>& p, const Triangle& index) {
  const bool first = left_of_edge(direction, p[0], p[1], index[0] < index[1]);
  if (first != left_of_edge(direction, p[1], p[2], index[1] < index[2])) return -1;
  if (first != left_of_edge(direction, p[2], p[0], index[2] < index[0])) return -1;
  const Vec3d normal = cross(p[1] - p[0], p[2] - p[0]);
  const double slope = dot(normal, direction);
  return slope != 0 ? dot(normal, p[0]) / slope : -1;
}

}  // namespace

PolarMap::PolarMap(const Body& body, const PolarMapOptions& options)
    : surface_(body.positions, body.mates),
      side_(longest_side(surface_.box())),
      centre_(surface_.box().centre()),
      table_(surface_, centre_, options.size > 0 ? options.size : body.positions.size()),
      walk_(options.walk) {}

PolarMap::RadialHits PolarMap::radial_hits(Vec3d offset, double radius) const noexcept {
  RadialHits hits;
  const Vec3d direction = normalized((radius > 0 ? (1 / radius) * offset : Vec3d{0, 1, 0}) + nudge);
  const Vec3d point = centre_ + offset;
  double min_turn = HUGE_VAL, min_squared = HUGE_VAL;
  for (const int t : table_.entries(table_.cell(direction))) {
    const Triangle& index = surface_.triangles()[t];
    const double squared = squared_length(surface_.position(index[0]) - point);
    if (squared < min_squared) {
      min_squared = squared;
      hits.nearest_sample = index[0];
    }
    const std::array<Vec3d, 3> p{surface_.position(index[0]) - centre_,
                                 surface_.position(index[1]) - centre_,
                                 surface_.position(index[2]) - centre_};
    const double along = ray_distance(direction, p, index);
    if (along <= 0) continue;
    if (along > radius) ++hits.beyond;
    if (std::abs(along - radius) < min_turn) {
      min_turn = std::abs(along - radius);
      hits.triangle = t;
      hits.radius = along;
    }
  }
  return hits;
}

bool PolarMap::inside(Vec3d point) const noexcept {
  const Vec3d offset = point - centre_;
  return surface_.closed() && radial_hits(offset, length(offset)).beyond % 2 != 0;
}

std::optional<SurfacePoint> PolarMap::printed(Vec3d offset, double radius,
                                              const RadialHits& hits) const noexcept {
  if (hits.nearest_sample < 0) return std::nullopt;
  const Vec3d point = centre_ + offset;
  if (hits.triangle < 0 || !(radius > 0)) {
    // The ray passes beside every triangle of its cell: the nearest vertex stands in.
    const Vec3d vertex = surface_.position(hits.nearest_sample);
    const ClosestOnSurface at = surface_.descend(vertex, hits.nearest_sample);
    const Vec3d normal = surface_.normal_at(at.triangle, vertex);
    return SurfacePoint{vertex, normal, dot(normal, point - vertex)};
  }
  const Vec3d position = centre_ + (hits.radius / radius) * offset;
  const Vec3d normal = surface_.normal_at(hits.triangle, position);
  return SurfacePoint{position, normal, dot(normal, point - position)};
}

std::optional<SurfacePoint> PolarMap::walked(Vec3d point, const RadialHits& hits) const noexcept {
  if (hits.nearest_sample < 0) return std::nullopt;
  const ClosestOnSurface closest = surface_.descend(point, hits.nearest_sample);
  const Vec3d smooth = surface_.normal_at(closest.triangle, closest.position);
  const Vec3d away = point - closest.position;
  const double distance = std::sqrt(closest.squared_distance);
  const bool behind = surface_.closed() ? hits.beyond % 2 != 0 : dot(away, smooth) < 0;
  const double sign = behind ? -1 : 1;
  const Vec3d normal = distance > touching * side_ ? (sign / distance) * away : smooth;
  return SurfacePoint{closest.position, normal, sign * distance};
}

std::optional<SurfacePoint> PolarMap::contact(Vec3d point, Vec3d start,
                                              double reach) const noexcept {
  const Vec3d offset = point - centre_;
  const double radius = length(offset);
  if (!(radius < std::sqrt(3.0) / 2 * side_ + reach)) return std::nullopt;
  if (radius > table_.farthest(table_.cell(offset)) + reach) return std::nullopt;
  const RadialHits hits = radial_hits(offset, radius);
  const std::optional<SurfacePoint> found =
      walk_ ? walked(point, hits) : printed(offset, radius, hits);
  if (!found || found->gap >= reach) return std::nullopt;
  const double deepest =
      surface_.closed() ? deepest_push * side_ : length(point - start) + open_depth * side_;
  if ((walk_ || !surface_.closed()) && found->gap < -deepest) return std::nullopt;
  return found;
}

}  // namespace weft
