#include "weft/convert/patch_unfolding.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

/// A minimisation ends where a step lowers the energy by less than this part of it.
constexpr double still = 1e-6;
/// Minimisations, each with a regularisation by what the last one left: at most, and at least.
constexpr int max_rounds = 12, min_rounds = 4;
/// The softness of the first round, and the least of all.
constexpr double first_softness = 0.1, min_softness = 1e-6;
/// Part of a negative area that softness adds to its least.
constexpr double softness_of_area = 0.2;
constexpr int smoothing_sweeps = 100;
/// Weight of a triangle's shape in the energy; that of its area is the rest.
constexpr double weight_of_shape = 0.5;
/// Of the square of a middle's distance from the surface, in spacings. With less, triangles bridge
/// what is concave; with more, they hardly move.
constexpr double weight_of_distance = 256;

double softness_for(double min_area) {
  const double of_area = softness_of_area * std::min(0.0, min_area);
  return std::sqrt(min_softness * min_softness + of_area * of_area);
}

}  // namespace

PatchUnfolding::Axes PatchUnfolding::axes_of(Vec3d normal) {
  const Vec3d aside = std::abs(normal.x) < 0.7 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  const Vec3d first = normalized(cross(normal, aside));
  return {first, cross(normal, first)};
}

PatchUnfolding::PatchUnfolding(std::span<const Point> points, std::span<const Triangle> triangles,
                               std::span<const PlaneAt> feet)
    : points_(points.begin(), points.end()) {
  for (const Point& point : points) axes_.push_back(axes_of(point.normal));
  double twice_area = 0;
  for (const auto& [a, b, c] : triangles)
    twice_area += length(
        cross(points[b].position - points[a].position, points[c].position - points[a].position));
  if (twice_area > 0) spacing_ = std::sqrt(twice_area / static_cast<double>(triangles.size()));
  for (std::size_t k = 0; k < triangles.size(); ++k)
    triangles_.push_back(flat(triangles[k], feet[k]));
}

/// All of it is linear in the displacements, so that their energy needs no more than this.
PatchUnfolding::Flat PatchUnfolding::flat(const Triangle& corners, const PlaneAt& foot) const {
  const auto [a, b, c] = corners;
  const Vec3d first = points_[a].position;
  const Axes plane = axes_of(normalized(points_[a].normal + points_[b].normal + points_[c].normal));
  const auto within = [&](Vec3d way) {
    return Vec2d{dot(way, plane.first), dot(way, plane.second)};
  };
  Flat made;
  made.corners = corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& [along, across] = axes_[corners[k]];
    if (points_[corners[k]].moves)
      made.moves[k] = {within(along), within(across),
                       (1.0 / 3) * Vec2d{dot(along, foot.normal), dot(across, foot.normal)}};
  }
  made.rest = {(1 / spacing_) * within(points_[b].position - first),
               (1 / spacing_) * within(points_[c].position - first)};
  const Vec3d middle = (1.0 / 3) * (first + points_[b].position + points_[c].position);
  made.off = (1 / spacing_) * dot(middle - foot.position, foot.normal);
  return made;
}

Vec3d PatchUnfolding::displacement(const Vectors& at, int point) const {
  const Axes& axes = axes_[point];
  return spacing_ * (at[point].x * axes.first + at[point].y * axes.second);
}

Vec3d PatchUnfolding::place(const Vectors& at, int point) const {
  return points_[point].position + displacement(at, point);
}

PatchUnfolding::Jacobian PatchUnfolding::jacobian(const Flat& triangle, const Vectors& at) {
  const auto moved = [&](int k) { return triangle.moves[k].moved(at[triangle.corners[k]]); };
  const Vec2d first = moved(0);
  return {triangle.rest.to_second + (moved(1) - first),
          triangle.rest.to_third + (moved(2) - first)};
}

double PatchUnfolding::min_area(const Vectors& at) const {
  double least = HUGE_VAL;
  for (const Flat& triangle : triangles_) least = std::min(least, jacobian(triangle, at).area());
  return least;
}

/// (w |J|^2 + (1 - w) (d^2 + 1)) / (2 chi) with the determinant d of J and
/// chi = (d + sqrt(s^2 + d^2)) / 2: about d where that is positive, else small and positive.
PatchUnfolding::Slopes PatchUnfolding::energy_of(const Jacobian& j, double softness) {
  const double area = j.area(), root = std::sqrt(softness * softness + area * area);
  const double per_chi = 2 / (area + root), slope_of_chi = 0.5 + 0.5 * area / root;
  const double shape = dot(j.to_second, j.to_second) + dot(j.to_third, j.to_third);
  const double value =
      0.5 * per_chi * (weight_of_shape * shape + (1 - weight_of_shape) * (area * area + 1));
  const double by_area = per_chi * ((1 - weight_of_shape) * area - value * slope_of_chi),
               by_shape = per_chi * weight_of_shape;
  return {value, by_shape * j.to_second + by_area * Vec2d{j.to_third.y, -j.to_third.x},
          by_shape * j.to_third + by_area * Vec2d{-j.to_second.y, j.to_second.x}};
}

double PatchUnfolding::energy(const Vectors& at, double softness, Vectors& gradient) const {
  double sum = 0;
  std::fill(gradient.begin(), gradient.end(), Vec2d{});
  for (const Flat& triangle : triangles_) {
    const Slopes slopes = energy_of(jacobian(triangle, at), softness);
    const double off = distance(triangle, at);
    sum += slopes.value + weight_of_distance * off * off;
    const std::array<Vec2d, 3> corners{Vec2d{} - slopes.second - slopes.third, slopes.second,
                                       slopes.third};
    for (std::size_t k = 0; k < 3; ++k) {
      const Flat::Corner& corner = triangle.moves[k];
      Vec2d& slope = gradient[triangle.corners[k]];
      slope = slope + corner.pulled(corners[k]) + (2 * weight_of_distance * off) * corner.off;
    }
  }
  return sum;
}

double PatchUnfolding::distance(const Flat& triangle, const Vectors& at) {
  double off = triangle.off;
  for (std::size_t k = 0; k < 3; ++k) off += dot(triangle.moves[k].off, at[triangle.corners[k]]);
  return off;
}

void PatchUnfolding::smooth(Vectors& at) const {
  for (int sweep = 0; sweep < smoothing_sweeps; ++sweep) {
    std::vector<Vec3d> sums(points_.size());
    std::vector<double> counts(points_.size());
    for (const Flat& triangle : triangles_)
      for (int k = 0; k < 3; ++k)
        for (const int other : {(k + 1) % 3, (k + 2) % 3}) {
          sums[triangle.corners[k]] += place(at, triangle.corners[other]);
          counts[triangle.corners[k]] += 1;
        }
    for (std::size_t p = 0; p < points_.size(); ++p) {
      if (!points_[p].moves) continue;
      const Vec3d way = (1 / spacing_) * ((1 / counts[p]) * sums[p] - points_[p].position);
      at[p] = {dot(way, axes_[p].first), dot(way, axes_[p].second)};
    }
  }
}

std::vector<Vec3d> PatchUnfolding::find(const Attempt& attempt) const {
  Vectors at(points_.size());
  if (attempt.from_smooth) smooth(at);
  double softness = std::max(first_softness, softness_for(min_area(at)));
  for (int round = 0; round < max_rounds && (round < min_rounds || min_area(at) <= 0); ++round) {
    descend([&](const Vectors& to, Vectors& slopes) { return energy(to, softness, slopes); }, at,
            {.max_steps = attempt.max_steps, .still = still});
    softness = softness_for(min_area(at));
  }
  std::vector<Vec3d> displacements;
  displacements.reserve(points_.size());
  for (int p = 0; p < static_cast<int>(points_.size()); ++p)
    displacements.push_back(displacement(at, p));
  return displacements;
}

}  // namespace weft
