#include "weft/collide/ccd.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace weft {
namespace {

constexpr double epsilon = 0x1p-53;
/// Rounding error bounds, in epsilons of the largest coordinate of a difference: of a corner's
/// height over a plane at some time (a difference, a product of vectors and an interpolation:
/// 5 + 5 + 6), and of the distance of a point given by its weights.
constexpr double height_error = 16, point_error = 64;
constexpr double min_tolerance = 2 * point_error;

using Weights = std::array<double, 4>;

/// Differences of the points of two primitives at one time: the corners, in cyclic order, of a
/// convex planar polygon.
struct Corners4 {
  std::array<Vec3d, 4> at{};
  int count = 0;
};

Corners4 differences(const VertexFace& p) {
  return {{p.vertex - p.face[0], p.vertex - p.face[1], p.vertex - p.face[2]}, 3};
}

Corners4 differences(const EdgeEdge& p) {
  return {{p.first[0] - p.second[0], p.first[1] - p.second[0], p.first[1] - p.second[1],
           p.first[0] - p.second[1]},
          4};
}

struct PolygonPoint {
  Vec3d point;
  double squared = HUGE_VAL;
  Weights weights{};
};

/// Finds the point of a planar polygon nearest to the origin. All edges and triangles are tried
/// independently, so that a triangle without area cannot mislead.
class NearestSearch {
 public:
  explicit NearestSearch(const Corners4& corners) : corners_(corners) {
    for (int k = 1; k + 1 < corners.count; ++k) {
      try_inside(0, k, k + 1);
      try_edge(0, k);
      try_edge(k, k + 1);
      try_edge(k + 1, 0);
    }
  }
  [[nodiscard]] const PolygonPoint& best() const { return best_; }

 private:
  void keep(const Weights& weights) {
    Vec3d point;
    for (int k = 0; k < corners_.count; ++k) point += weights[k] * corners_.at[k];
    const double squared = squared_length(point);
    if (squared < best_.squared) best_ = {point, squared, weights};
  }

  void try_edge(int i, int j) {
    const Vec3d along = corners_.at[j] - corners_.at[i];
    const double squared = squared_length(along);
    const double place = squared > 0 ? -dot(corners_.at[i], along) / squared : 0;
    Weights weights{};
    weights[j] = std::clamp(place, 0.0, 1.0);
    weights[i] = 1 - weights[j];
    keep(weights);
  }

  void try_inside(int i, int j, int k) {
    const Vec3d a = corners_.at[i], b = corners_.at[j], c = corners_.at[k];
    const Vec3d normal = cross(b - a, c - a);
    const double area = squared_length(normal);
    if (!(area > 0)) return;
    Weights weights{};
    weights[j] = dot(cross(c, a), normal) / area;
    weights[k] = dot(cross(a, b), normal) / area;
    weights[i] = 1 - weights[j] - weights[k];
    if (weights[i] >= 0 && weights[j] >= 0 && weights[k] >= 0) keep(weights);
  }

  const Corners4& corners_;
  PolygonPoint best_;
};

/// The moving polygon of differences of two primitives.
class MovingHull {
 public:
  MovingHull(const Corners4& start, const Corners4& end) : start_(start), end_(end) {
    for (const Corners4* corners : {&start_, &end_})
      for (int k = 0; k < corners->count; ++k)
        for (const double x : {corners->at[k].x, corners->at[k].y, corners->at[k].z})
          extent_ = std::max(extent_, std::abs(x));
  }
  /// The largest coordinate of a difference. [m]
  [[nodiscard]] double extent() const { return extent_; }

  [[nodiscard]] Corners4 at(double time) const {
    Corners4 now;
    now.count = start_.count;
    for (int k = 0; k < now.count; ++k) now.at[k] = (1 - time) * start_.at[k] + time * end_.at[k];
    return now;
  }

  /// Time up to which all corners certainly stay farther than `separation` above the plane through
  /// the origin with this normal.
  /// @return `time` itself when that cannot be shown
  [[nodiscard]] double apart_until(double time, Vec3d normal, double separation) const {
    const double size = std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z);
    const double error = height_error * epsilon * extent_ * size;
    const double min = separation * length(normal) * (1 + 8 * epsilon) + error;
    double until = 1;
    for (int k = 0; k < start_.count; ++k) {
      const double first = dot(normal, start_.at[k]), last = dot(normal, end_.at[k]);
      if (last > min) continue;
      // The target height is raised by `error`, which covers the rounding of the division.
      until = std::min(until, (first - min - error) / (first - last));
    }
    const auto all_above = [&](double t) {
      for (int k = 0; k < start_.count; ++k)
        if (!((1 - t) * dot(normal, start_.at[k]) + t * dot(normal, end_.at[k]) > min))
          return false;
      return true;
    };
    // Heights are linear in time: what holds at both ends holds between them.
    return until > time && all_above(time) && all_above(until) ? until : time;
  }

 private:
  Corners4 start_, end_;
  double extent_ = 0;
};

/// Fallback for near pairs, where cancellation in the nearest point may tilt its plane into the
/// polygon: tries planes parallel to the polygon's edges and triangles instead.
/// @return the latest time, see apart_until
double apart_by_any_plane(const MovingHull& piece, const Impact& impact, Vec3d displacement,
                          double separation) {
  const Corners4 now = piece.at(impact.time);
  double until = impact.time;
  const auto try_normal = [&](Vec3d normal) {
    until = std::max(until, piece.apart_until(impact.time, normal, separation));
  };
  for (int i = 0; i < now.count; ++i)
    for (int j = 0; j < i; ++j) {
      const Vec3d edge = normalized(now.at[j] - now.at[i]);
      const Vec3d across = normalized(displacement - dot(displacement, edge) * edge);
      try_normal(across - dot(across, edge) * edge);
      for (int k = 0; k < j; ++k) {
        const Vec3d normal = normalized(cross(now.at[i] - now.at[k], now.at[j] - now.at[k]));
        try_normal(normal);
        try_normal(-normal);
      }
    }
  return until;
}

template <class Pair>
std::optional<Impact> first_impact(const Pair& start, const Pair& end, const CcdOptions& options) {
  const MovingHull piece(differences(start), differences(end));
  // Two points with three coordinates each: 2 sqrt(3) < 3.5.
  const double separation = options.separation + 3.5 * options.input_error;
  const double rounding = epsilon * piece.extent();
  const double enough = separation + std::max(options.tolerance, min_tolerance * rounding);
  Impact impact;
  for (impact.steps = 1;; ++impact.steps) {
    const PolygonPoint nearest = NearestSearch(piece.at(impact.time)).best();
    const Weights& w = nearest.weights;
    constexpr bool edges = std::is_same_v<Pair, EdgeEdge>;
    impact.u = edges ? w[1] + w[2] : w[1];
    impact.v = edges ? w[2] + w[3] : w[2];
    impact.distance = std::sqrt(nearest.squared) + point_error * rounding;
    if (impact.distance <= enough || impact.steps >= options.max_steps) return impact;
    double until = piece.apart_until(impact.time, nearest.point, separation);
    if (until <= impact.time) until = apart_by_any_plane(piece, impact, nearest.point, separation);
    if (until >= 1) return std::nullopt;
    if (until <= impact.time) return impact;
    impact.time = until;
  }
}

}  // namespace

std::optional<Impact> time_of_impact(const VertexFace& start, const VertexFace& end,
                                     const CcdOptions& options) noexcept {
  return first_impact(start, end, options);
}

std::optional<Impact> time_of_impact(const EdgeEdge& start, const EdgeEdge& end,
                                     const CcdOptions& options) noexcept {
  return first_impact(start, end, options);
}

}  // namespace weft
