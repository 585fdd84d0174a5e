#include "weft/camera.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "weft/core/math.h"

namespace weft {

namespace {

bool is_finite(Vec3d p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

Box3d usable(const Box3d& box) {
  if (!box.empty() && is_finite(box.lower) && is_finite(box.upper)) return box;
  return {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}};
}

Vec3d corner(const Box3d& box, int i) {
  return {(i & 1) != 0 ? box.upper.x : box.lower.x, (i & 2) != 0 ? box.upper.y : box.lower.y,
          (i & 4) != 0 ? box.upper.z : box.lower.z};
}

/// Bounds on the eye along one axis of the picture, for a frustum whose half opening has the
/// tangent `slope`: an eye at (side, depth) sees all points when side - slope depth >= high and
/// -side - slope depth >= low.
struct Reach {
  double high = -HUGE_VAL, low = -HUGE_VAL, slope = 1;
  void add(double side, double depth) {
    high = std::max(high, side - slope * depth);
    low = std::max(low, -side - slope * depth);
  }
  [[nodiscard]] double deepest_eye() const { return -(high + low) / (2 * slope); }
  [[nodiscard]] double middle() const { return (high - low) / 2; }
};

}  // namespace

Camera frame_points(std::span<const Vec3d> points, double azimuth, double elevation,
                    double aspect) {
  Box3d box;
  for (const Vec3d p : points) box.add(p);
  if (box.empty()) return frame_box({}, azimuth, elevation, aspect);
  const Vec3d right{cosine(azimuth), 0, -sine(azimuth)};
  const Vec3d forward{-sine(azimuth) * cosine(elevation), -sine(elevation),
                      -cosine(azimuth) * cosine(elevation)};
  Camera camera;
  camera.up = cross(right, forward);
  const double slope = sine(camera.vertical_angle / 2) / cosine(camera.vertical_angle / 2);
  Reach across;
  Reach along;
  along.slope = slope * (1 - frame_margin);
  across.slope = along.slope * aspect;
  for (const Vec3d point : points) {
    const Vec3d p = point - box.centre();
    across.add(dot(p, right), dot(p, forward));
    along.add(dot(p, camera.up), dot(p, forward));
  }
  // A single point has no extent: the eye keeps a distance of 1.
  const double room = box.diagonal() > 0 ? 0 : 1;
  const double depth = std::min(across.deepest_eye(), along.deepest_eye()) - room;
  camera.eye =
      box.centre() + across.middle() * right + along.middle() * camera.up + depth * forward;
  camera.target = camera.eye - depth * forward;
  return camera;
}

Camera frame_box(const Box3d& box, double azimuth, double elevation, double aspect) {
  const Box3d seen = usable(box);
  std::array<Vec3d, 8> corners;
  for (int i = 0; i < 8; ++i) corners[i] = corner(seen, i);
  return frame_points(corners, azimuth, elevation, aspect);
}

Box3d bounds(const Planes3& positions) {
  Box3d box;
  for (int r = 0; r < positions.size(); ++r)
    for (int c = 0; c < positions.size(); ++c) {
      const auto p = vec_cast<double>(positions.at(r, c));
      if (is_finite(p)) box.add(p);
    }
  return box;
}

namespace {

constexpr int spiral_count = 128;
/// Number of angles that stand for a whole turn.
constexpr int turn_steps = 32;

/// Evenly spread directions over the sphere: a golden-angle spiral.
Vec3d spiral_side(int i) {
  const double y = 1 - 2 * (i + 0.5) / spiral_count;
  const double radius = std::sqrt(1 - y * y);
  const double angle = i * (3 - std::sqrt(5.0)) * pi;
  return {radius * cosine(angle), y, radius * sine(angle)};
}

}  // namespace

Outline::Outline() : farthest_{} {
  for (int i = 0; i < spiral_count; ++i) sides_[i] = spiral_side(i);
  for (int axis = 0; axis < 3; ++axis)
    for (int back = 0; back < 2; ++back) {
      const double way = back == 0 ? 1 : -1;
      sides_[spiral_count + 2 * axis + back] = {axis == 0 ? way : 0, axis == 1 ? way : 0,
                                                axis == 2 ? way : 0};
    }
  distance_.fill(-HUGE_VAL);
}

void Outline::add(Vec3d point) {
  if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) return;
  for (int i = 0; i < side_count; ++i) {
    const double distance = dot(sides_[i], point);
    if (distance > distance_[i]) {
      distance_[i] = distance;
      farthest_[i] = point;
    }
  }
}

void Outline::add(const Planes3& positions) {
  for (int r = 0; r < positions.size(); ++r)
    for (int c = 0; c < positions.size(); ++c) add(vec_cast<double>(positions.at(r, c)));
}

void Outline::add(const TriangleMesh& mesh) {
  std::vector<bool> used(mesh.positions.size());
  for (const Triangle& t : mesh.triangles)
    for (const int v : t) used[v] = true;
  for (std::size_t v = 0; v < used.size(); ++v)
    if (used[v]) add(mesh.positions[v]);
}

void Outline::add(const Outline& other) {
  for (const Vec3d p : other.points()) add(p);
}

std::vector<Vec3d> Outline::points() const {
  if (distance_[0] == -HUGE_VAL) return {};
  return {farthest_.begin(), farthest_.end()};
}

std::vector<Vec3d> Outline::points_turning() const {
  Box3d box;
  for (const Vec3d p : points()) box.add(p);
  std::vector<Vec3d> turned;
  for (const Vec3d p : points()) {
    const double x = p.x - box.centre().x, z = p.z - box.centre().z;
    for (int k = 0; k < turn_steps; ++k) {
      const double c = cosine(2 * pi * k / turn_steps), s = sine(2 * pi * k / turn_steps);
      turned.push_back({box.centre().x + c * x + s * z, p.y, box.centre().z + c * z - s * x});
    }
  }
  return turned;
}

}  // namespace weft
