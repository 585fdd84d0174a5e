#include "weft/param/vertex_star.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "weft/core/orientation.h"

namespace weft {

Vec2d Symmetric2::solve(Vec2d rhs) const {
  return 1 / determinant() * Vec2d{yy * rhs.x - xy * rhs.y, xx * rhs.y - xy * rhs.x};
}

void Symmetric2::add(double scale, Vec2d a, Vec2d b) {
  xx += scale * a.x * b.x;
  xy += 0.5 * scale * (a.x * b.y + a.y * b.x);
  yy += scale * a.y * b.y;
}

void VertexStar::gather(const CollapseHierarchy& mesh, std::span<const StarTriangle> triangles,
                        std::span<const Vec2d> uv, int vertex) {
  corners_.clear();
  mesh.around(vertex, [&](int h) {
    const auto& [s, quartic, inverse] = triangles[h / 3];
    const Vec2d a = uv[mesh.to(h)];
    const Vec2d b = uv[mesh.from(HalfEdges::previous(h))];
    // The metric of SurfaceTriangle is given on the edges from corner 0.
    const double third_side = s.g11 - 2 * s.g12 + s.g22;
    if (h % 3 == 0) {
      corners_.push_back({a, b, s.g11, s.g12, s.g22, s.area, quartic, inverse});
    } else if (h % 3 == 1) {
      corners_.push_back({a, b, third_side, s.g11 - s.g12, s.g11, s.area, quartic, inverse});
    } else {
      corners_.push_back({a, b, s.g22, s.g22 - s.g12, third_side, s.area, quartic, inverse});
    }
  });
}

double VertexStar::energy(Vec2d place) const {
  double sum = 0;
  for (const Corner& c : corners_) {
    const Vec2d p = c.a - place;
    const Vec2d q = c.b - place;
    const double d = cross(p, q);
    if (!(d > 0)) return std::numeric_limits<double>::infinity();
    const double n = c.g11 * dot(q, q) - 2 * c.g12 * dot(p, q) + c.g22 * dot(p, p);
    const double m = 0.5 * n / (d * d);
    sum += c.area * m * (1 + 0.5 * c.quartic * m) + c.inverse * n;
  }
  return sum;
}

bool VertexStar::is_valid(Vec2d place) const {
  return std::all_of(corners_.begin(), corners_.end(),
                     [&](const Corner& c) { return orientation(place, c.a, c.b) > 0; });
}

double VertexStar::free_step_length(Vec2d place, Vec2d step) const {
  double step_length = std::numeric_limits<double>::infinity();
  for (const Corner& c : corners_) {
    const double closing = cross(c.b - c.a, step);
    if (closing < 0)
      step_length = std::min(step_length, cross(c.a - place, c.b - place) / -closing);
  }
  return step_length;
}

VertexStar::Model VertexStar::model(Vec2d place) const {
  Model model;
  for (const Corner& c : corners_) {
    const Vec2d p = c.a - place;
    const Vec2d q = c.b - place;
    const double inverse = 1 / cross(p, q);
    const double half = 0.5 * inverse * inverse;
    const double n = c.g11 * dot(q, q) - 2 * c.g12 * dot(p, q) + c.g22 * dot(p, p);
    const Vec2d n1 = -2.0 * ((c.g11 - c.g12) * q + (c.g22 - c.g12) * p);
    const Vec2d d1 = inverse * Vec2d{c.a.y - c.b.y, c.b.x - c.a.x};
    const double m = half * n;
    const Vec2d m1 = half * (n1 - 2 * n * d1);
    const double factor = c.area * (1 + c.quartic * m);
    const double weight = factor * half;
    model.energy += c.area * m * (1 + 0.5 * c.quartic * m) + c.inverse * n;
    model.gradient = model.gradient + factor * m1 + c.inverse * n1;
    const double n2 = 2 * (c.g11 - 2 * c.g12 + c.g22) * (weight + c.inverse);
    for (Symmetric2* sum : {&model.hessian, &model.squares}) {
      sum->xx += n2;
      sum->yy += n2;
      sum->add(c.area * c.quartic, m1, m1);
    }
    model.hessian.add(-4 * weight, n1, d1);
    model.hessian.add(6 * weight * n, d1, d1);
    model.squares.add(-2 * weight, n1, d1);
    model.squares.add(2 * weight * n, d1, d1);
  }
  return model;
}

std::vector<Vec2d> VertexStar::ring() const {
  std::vector<Vec2d> ring;
  for (const Corner& c : corners_) ring.push_back(c.a);
  return ring;
}

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

/// The kernel in coordinates relative to the ring's first point, which avoids cancellation in small
/// rings.
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
