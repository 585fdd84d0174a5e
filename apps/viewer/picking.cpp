#include "apps/viewer/picking.h"

#include <array>
#include <cmath>

namespace weft::viewer {
namespace {

/// The distance to a triangle along a ray, by its determinants [moller97]; infinite where it is
/// missed.
double distance_to(const Ray& ray, const std::array<Vec3d, 3>& corners) {
  const Vec3d u = corners[1] - corners[0], v = corners[2] - corners[0];
  const Vec3d p = cross(ray.direction, v);
  const double det = dot(u, p);
  if (det == 0) return HUGE_VAL;
  const Vec3d from = ray.from - corners[0];
  const double a = dot(from, p) / det;
  const Vec3d q = cross(from, u);
  const double b = dot(ray.direction, q) / det;
  if (!(a >= 0 && b >= 0 && a + b <= 1)) return HUGE_VAL;
  const double distance = dot(v, q) / det;
  return distance > 0 ? distance : HUGE_VAL;
}

/// Whether a ray meets a box within a distance.
bool is_near(const Ray& ray, const Box3d& box, double limit) {
  double enter = 0, leave = limit;
  const auto cut = [&](double from, double way, double low, double high) {
    if (way == 0) {
      if (from < low || from > high) leave = -1;
      return;
    }
    const double a = (low - from) / way, b = (high - from) / way;
    enter = std::fmax(enter, std::fmin(a, b));
    leave = std::fmin(leave, std::fmax(a, b));
  };
  cut(ray.from.x, ray.direction.x, box.lower.x, box.upper.x);
  cut(ray.from.y, ray.direction.y, box.lower.y, box.upper.y);
  cut(ray.from.z, ray.direction.z, box.lower.z, box.upper.z);
  return enter <= leave;
}

Box3d box_of_rows(const Planes3& positions, int row) {
  Box3d box;
  for (int r = row; r <= row + 1; ++r)
    for (int c = 0; c < positions.size(); ++c) box.add(vec_cast<double>(positions.at(r, c)));
  return box;
}

struct Search {
  const Ray& ray;
  const Planes3& positions;
  double min = HUGE_VAL;
  int sample = -1;

  void triangle(std::array<int, 3> samples) {
    std::array<Vec3d, 3> corners;
    for (int k = 0; k < 3; ++k) corners[k] = vec_cast<double>(positions.at(samples[k]));
    const double distance = distance_to(ray, corners);
    if (!(distance < min)) return;
    min = distance;
    const Vec3d met = ray.from + distance * ray.direction;
    double nearest = HUGE_VAL;
    for (int k = 0; k < 3; ++k) {
      const double squared = squared_length(corners[k] - met);
      if (!(squared < nearest)) continue;
      nearest = squared;
      sample = samples[k];
    }
  }
};

}  // namespace

std::optional<GridHit> meet_grid(const Ray& ray, const Planes3& positions) {
  Search search{ray, positions};
  const int n = positions.size();
  for (int r = 0; r + 1 < n; ++r) {
    if (!is_near(ray, box_of_rows(positions, r), search.min)) continue;
    for (int c = 0; c + 1 < n; ++c) {
      const int a = r * n + c;
      search.triangle({a, a + 1, a + n + 1});
      search.triangle({a, a + n + 1, a + n});
    }
  }
  if (search.sample < 0) return std::nullopt;
  return GridHit{search.min, search.sample};
}

std::optional<ClothHit> pick_cloth(const Ray& ray, const Snapshot& snapshot) {
  std::optional<ClothHit> found;
  double min = HUGE_VAL;
  for (std::size_t i = 0; i < snapshot.cloths.size(); ++i) {
    const auto hit = meet_grid(ray, snapshot.cloths[i]);
    if (!hit || !(hit->distance < min)) continue;
    min = hit->distance;
    found = ClothHit{i, hit->sample, vec_cast<double>(snapshot.cloths[i].at(hit->sample))};
  }
  if (!found) return found;
  for (std::size_t i = 0; i < snapshot.bodies.size(); ++i) {
    const SubjectSurface& body = snapshot.subject->bodies[i];
    const auto hit = meet_grid(ray, body.moves ? snapshot.bodies[i] : body.start);
    if (hit && hit->distance < min) return std::nullopt;
  }
  return found;
}

}  // namespace weft::viewer
