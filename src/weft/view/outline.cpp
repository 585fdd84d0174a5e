#include <cmath>

#include "weft/camera.h"
#include "weft/core/math.h"

namespace weft {
namespace {

constexpr int spiral_count = 128;
/// How many places of a turn stand for all.
constexpr int turn_steps = 32;

/// Even over the sphere: a spiral with the golden angle.
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
  for (const Vec3d p : mesh.positions) add(p);
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
