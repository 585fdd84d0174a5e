#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "weft/collide/broad_phase/node_levels.h"
#include "weft/collide/moving_surface.h"

namespace weft::bench {

// The bounding volumes of the hierarchies that the paper's survey names. Each is fitted to points
// and tells by how much it is certainly apart from another of its kind, by the tests of its
// authors.

/// Around the middle of the points' box [benes05].
struct Sphere {
  explicit Sphere(std::span<const Vec3d> points) {
    Box3d box;
    for (const Vec3d& p : points) box.add(p);
    centre = box.centre();
    for (const Vec3d& p : points) radius = std::max(radius, length(p - centre));
  }
  [[nodiscard]] double gap_to(const Sphere& other) const {
    return length(centre - other.centre) - radius - other.radius;
  }
  Vec3d centre;
  double radius = 0;
};

/// Directions of k-DOPs: the axes, then the diagonals of two axes, then (13) those of all three.
template <int Directions>
std::array<Vec3d, Directions> dop_directions() {
  constexpr std::array<Vec3d, 13> all{{{1, 0, 0},
                                       {0, 1, 0},
                                       {0, 0, 1},
                                       {1, 1, 0},
                                       {1, -1, 0},
                                       {1, 0, 1},
                                       {1, 0, -1},
                                       {0, 1, 1},
                                       {0, 1, -1},
                                       {1, 1, 1},
                                       {1, 1, -1},
                                       {1, -1, 1},
                                       {-1, 1, 1}}};
  std::array<Vec3d, Directions> chosen;
  for (std::size_t k = 0; k < Directions; ++k) chosen[k] = normalized(all[k]);
  return chosen;
}

/// Between pairs of planes across fixed directions: an axis-aligned box has three, the 18-DOP nine,
/// the 26-DOP thirteen [klosowski98].
template <int Directions>
struct DiscreteOriented {
  explicit DiscreteOriented(std::span<const Vec3d> points) {
    static const std::array along = dop_directions<Directions>();
    lower.fill(HUGE_VAL);
    upper.fill(-HUGE_VAL);
    for (const Vec3d& p : points)
      for (std::size_t k = 0; k < Directions; ++k) {
        const double at = dot(along[k], p);
        lower[k] = std::min(lower[k], at);
        upper[k] = std::max(upper[k], at);
      }
  }
  [[nodiscard]] double gap_to(const DiscreteOriented& other) const {
    double gap = -HUGE_VAL;
    for (std::size_t k = 0; k < Directions; ++k)
      gap = std::max({gap, lower[k] - other.upper[k], other.lower[k] - upper[k]});
    return gap;
  }
  std::array<double, Directions> lower, upper;
};

/// A box along the principal axes of the points, told apart along the fifteen axes of two boxes
/// [gottschalk96].
struct Oriented {
  explicit Oriented(std::span<const Vec3d> points) {
    Vec3d mean;
    for (const Vec3d& p : points) mean += (1.0 / static_cast<double>(points.size())) * p;
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Vec3d& p : points) {
      const Eigen::Vector3d d(p.x - mean.x, p.y - mean.y, p.z - mean.z);
      spread += d * d.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d v = solver.eigenvectors().col(k);
      axes[static_cast<std::size_t>(k)] = {v.x(), v.y(), v.z()};
    }
    fit(points);
  }
  [[nodiscard]] double gap_to(const Oriented& other) const {
    double gap = -HUGE_VAL;
    const Vec3d between = other.centre - centre;
    const auto look_along = [&](Vec3d axis) {
      const double size = length(axis);
      if (size < 1e-9) return;
      gap = std::max(
          gap, (std::abs(dot(axis, between)) - half_along(axis) - other.half_along(axis)) / size);
    };
    for (const Vec3d& axis : axes) look_along(axis);
    for (const Vec3d& axis : other.axes) look_along(axis);
    for (const Vec3d& a : axes)
      for (const Vec3d& b : other.axes) look_along(cross(a, b));
    return gap;
  }
  std::array<Vec3d, 3> axes;
  Vec3d centre, half;

 private:
  void fit(std::span<const Vec3d> points) {
    Box3d box;
    for (const Vec3d& p : points) box.add({dot(axes[0], p), dot(axes[1], p), dot(axes[2], p)});
    const Vec3d middle = box.centre();
    centre = middle.x * axes[0] + middle.y * axes[1] + middle.z * axes[2];
    half = 0.5 * (box.upper - box.lower);
  }
  [[nodiscard]] double half_along(Vec3d axis) const {
    return half.x * std::abs(dot(axis, axes[0])) + half.y * std::abs(dot(axis, axes[1])) +
           half.z * std::abs(dot(axis, axes[2]));
  }
};

/// Volumes of one kind around the samples that each node of a surface's mip pyramid passes in a
/// step.
template <class Volume>
class VolumeLevels {
 public:
  explicit VolumeLevels(const MovingSurface& surface) : sides_(level_sides(surface.grid->cells())) {
    for (int level = 0; level < static_cast<int>(sides_.size()); ++level) {
      levels_.emplace_back();
      for (int r = 0; r < sides_[static_cast<std::size_t>(level)]; ++r)
        for (int c = 0; c < sides_[static_cast<std::size_t>(level)]; ++c)
          levels_.back().emplace_back(points_of(surface, {level, r, c}));
    }
  }
  [[nodiscard]] const std::vector<int>& sides() const { return sides_; }
  [[nodiscard]] Node root() const { return {static_cast<int>(sides_.size()) - 1, 0, 0}; }
  [[nodiscard]] const Volume& at(const Node& node) const {
    const auto level = static_cast<std::size_t>(node.level);
    return levels_[level][static_cast<std::size_t>(node.row) * sides_[level] + node.col];
  }

 private:
  std::span<const Vec3d> points_of(const MovingSurface& surface, const Node& node) {
    const int wide = 1 << node.level, last = surface.grid->cells();
    points_.clear();
    for (const Planes3* planes : {surface.start, surface.end})
      for (int r = node.row * wide; r <= std::min(last, (node.row + 1) * wide); ++r)
        for (int c = node.col * wide; c <= std::min(last, (node.col + 1) * wide); ++c)
          points_.push_back(vec_cast<double>(planes->at(r, c)));
    return points_;
  }

  std::vector<int> sides_;
  std::vector<std::vector<Volume>> levels_;
  std::vector<Vec3d> points_;
};

}  // namespace weft::bench
