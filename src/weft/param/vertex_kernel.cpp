#include "weft/param/vertex_kernel.h"

#include <algorithm>
#include <vector>

#include "weft/core/orientation.h"

namespace weft {
namespace {

/// The part of a convex polygon to the left of the line from a along d.
std::vector<Vec2d> clip(const std::vector<Vec2d>& polygon, Vec2d a, Vec2d d) {
  std::vector<Vec2d> left;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2d p = polygon[i];
    const Vec2d q = polygon[(i + 1) % polygon.size()];
    const double at_p = cross(d, p - a);
    const double at_q = cross(d, q - a);
    if (at_p >= 0) left.push_back(p);
    if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0))
      left.push_back(p + at_p / (at_p - at_q) * (q - p));
  }
  return left;
}

/// The kernel relative to the ring's first point, whose neighbourhood matters most: a vertex that
/// was collapsed onto it comes back beside it.
std::vector<Vec2d> kernel(std::span<const Vec2d> ring) {
  Vec2d lower{}, upper{};
  for (const Vec2d p : ring) {
    lower = {std::min(lower.x, p.x - ring[0].x), std::min(lower.y, p.y - ring[0].y)};
    upper = {std::max(upper.x, p.x - ring[0].x), std::max(upper.y, p.y - ring[0].y)};
  }
  std::vector<Vec2d> polygon = {lower, {upper.x, lower.y}, upper, {lower.x, upper.y}};
  for (std::size_t i = 0; i < ring.size() && !polygon.empty(); ++i)
    polygon = clip(polygon, ring[i] - ring[0], ring[(i + 1) % ring.size()] - ring[i]);
  return polygon;
}

Vec2d mean(const std::vector<Vec2d>& points) {
  Vec2d sum{};
  for (const Vec2d p : points) sum = sum + p;
  return (1.0 / static_cast<double>(points.size())) * sum;
}

std::optional<Vec2d> centroid(const std::vector<Vec2d>& polygon) {
  double area = 0;
  Vec2d sum{};
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Vec2d p = polygon[i - 1] - polygon[0];
    const Vec2d q = polygon[i] - polygon[0];
    area += cross(p, q);
    sum = sum + cross(p, q) * (p + q);
  }
  if (!(area > 0)) return {};
  return polygon[0] + 1 / (3 * area) * sum;
}

}  // namespace

bool sees_all(std::span<const Vec2d> ring, Vec2d point) {
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (orientation(point, ring[i], ring[(i + 1) % ring.size()]) <= 0) return false;
  return true;
}

std::optional<Vec2d> kernel_point(std::span<const Vec2d> ring) {
  const std::vector<Vec2d> polygon = kernel(ring);
  if (polygon.empty()) return {};
  if (const std::optional<Vec2d> middle = centroid(polygon))
    if (sees_all(ring, ring[0] + *middle)) return ring[0] + *middle;
  const Vec2d point = ring[0] + mean(polygon);
  if (sees_all(ring, point)) return point;
  return {};
}

}  // namespace weft
