#include "weft/collide/baselines/polar_surface.h"

#include <algorithm>
#include <array>
#include <utility>

#include "weft/core/math.h"
#include "weft/geometry_image.h"
#include "weft/mesh/distance.h"

namespace weft {
namespace {

// Walks are short from a good seed; the caps only bound the work on bad input.
constexpr int max_sample_steps = 64;
constexpr int max_triangle_steps = 8;

double angle_between(Vec3d a, Vec3d b) {
  const double lengths = length(a) * length(b);
  return lengths > 0 ? arc_cosine(dot(a, b) / lengths) : 0;
}

}  // namespace

Vec3d barycentric(Vec3d point, Vec3d a, Vec3d b, Vec3d c) {
  const Vec3d normal = cross(b - a, c - a);
  const double area = dot(normal, normal);
  if (!(area > 0)) return {1.0 / 3, 1.0 / 3, 1.0 / 3};
  const double weight_a = dot(cross(b - point, c - point), normal) / area;
  const double weight_b = dot(cross(c - point, a - point), normal) / area;
  return {weight_a, weight_b, 1 - weight_a - weight_b};
}

GridSurface::GridSurface(const Planes3& positions, const BorderMates& mates) {
  const int samples = positions.size() * positions.size();
  positions_.reserve(samples);
  for (int s = 0; s < samples; ++s) positions_.push_back(positions.at(s));
  for (const Vec3f& p : positions_) box_.add(vec_cast<double>(p));
  join_triangles(positions, mates);
  find_incident();
  find_normals();
  closed_ = every_edge_has_two_triangles();
}

void GridSurface::join_triangles(const Planes3& positions, const BorderMates& mates) {
  GeometryImage image;
  image.cube = positions;
  image.mates = mates;
  for (const Triangle& samples : grid_triangles(image)) {
    Triangle joined{};
    for (int k = 0; k < 3; ++k) joined[k] = mates.representative(samples[k]);
    const bool repeated =
        joined[0] == joined[1] || joined[1] == joined[2] || joined[2] == joined[0];
    if (!repeated) triangles_.push_back(joined);
  }
}

void GridSurface::find_incident() {
  starts_.assign(positions_.size() + 1, 0);
  for (const Triangle& t : triangles_)
    for (const int corner : t) ++starts_[corner + 1];
  for (std::size_t s = 1; s < starts_.size(); ++s) starts_[s] += starts_[s - 1];
  incident_.resize(3 * triangles_.size());
  std::vector<int> next(starts_.begin(), starts_.end() - 1);
  for (int t = 0; t < static_cast<int>(triangles_.size()); ++t)
    for (const int corner : triangles_[t]) incident_[next[corner]++] = t;
}

void GridSurface::find_normals() {
  std::vector<Vec3d> sums(positions_.size());
  for (const Triangle& t : triangles_) {
    const std::array<Vec3d, 3> p{position(t[0]), position(t[1]), position(t[2])};
    const Vec3d normal = normalized(cross(p[1] - p[0], p[2] - p[0]));
    for (int k = 0; k < 3; ++k)
      sums[t[k]] += angle_between(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]) * normal;
  }
  normals_.reserve(sums.size());
  for (const Vec3d& sum : sums) normals_.push_back(vec_cast<float>(normalized(sum)));
}

bool GridSurface::every_edge_has_two_triangles() const {
  std::vector<std::pair<int, int>> edges;
  edges.reserve(3 * triangles_.size());
  for (const Triangle& t : triangles_)
    for (int k = 0; k < 3; ++k) edges.push_back(std::minmax(t[k], t[(k + 1) % 3]));
  std::sort(edges.begin(), edges.end());
  if (edges.empty() || edges.size() % 2 != 0) return false;
  for (std::size_t i = 0; i < edges.size(); i += 2) {
    const bool pair = edges[i] == edges[i + 1];
    const bool alone = i + 2 == edges.size() || edges[i + 1] != edges[i + 2];
    if (!pair || !alone) return false;
  }
  return true;
}

int GridSurface::nearest_sample(Vec3d point, int seed) const noexcept {
  int best = seed;
  double min = squared_length(point - position(seed));
  for (int step = 0; step < max_sample_steps; ++step) {
    const int here = best;
    for (const int t : incident(here))
      for (const int corner : triangles_[t]) {
        const double squared = squared_length(point - position(corner));
        if (squared < min) {
          min = squared;
          best = corner;
        }
      }
    if (best == here) break;
  }
  return best;
}

ClosestOnSurface GridSurface::descend(Vec3d point, int seed) const noexcept {
  ClosestOnSurface best;
  int sample = nearest_sample(point, seed);
  for (int step = 0; step < max_triangle_steps; ++step) {
    const double before = best.squared_distance;
    for (const int t : incident(sample)) {
      const auto [a, b, c] = triangles_[t];
      const Vec3d closest = closest_on_triangle(point, position(a), position(b), position(c));
      const double squared = squared_length(point - closest);
      if (squared < best.squared_distance) best = {closest, t, squared};
    }
    if (!(best.squared_distance < before)) break;
    // The corner that the closest point lies nearest to; the triangles around it may come closer
    // still.
    const Triangle& corners = triangles_[best.triangle];
    const int next = *std::min_element(corners.begin(), corners.end(), [&](int p, int q) {
      return squared_length(best.position - position(p)) <
             squared_length(best.position - position(q));
    });
    if (next == sample) break;
    sample = next;
  }
  return best;
}

Vec3d GridSurface::normal_at(int triangle, Vec3d point) const noexcept {
  const auto [a, b, c] = triangles_[triangle];
  const Vec3d weights = barycentric(point, position(a), position(b), position(c));
  return normalized(weights.x * vec_cast<double>(normals_[a]) +
                    weights.y * vec_cast<double>(normals_[b]) +
                    weights.z * vec_cast<double>(normals_[c]));
}

}  // namespace weft
