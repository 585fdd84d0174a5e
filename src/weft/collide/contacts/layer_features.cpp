#include "weft/collide/contacts/layer_features.h"

#include <algorithm>
#include <cmath>

#include "weft/collide/contacts/closest.h"
#include "weft/core/contact_point.h"

namespace weft {
namespace {

/// Square of the cosine of 45 degrees.
constexpr double squared_steep = 0.5;

bool has_all(const std::array<int, 3>& triangle, const std::array<int, 2>& feature) {
  return std::all_of(feature.begin(), feature.end(), [&](int sample) {
    return std::find(triangle.begin(), triangle.end(), sample) != triangle.end();
  });
}

bool is_edge(const std::array<int, 2>& a, const std::array<int, 2>& b) {
  return a == b || (a[0] == b[1] && a[1] == b[0]);
}

}  // namespace

bool SurfaceCell::shares_corner(const SurfaceCell& other) const {
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      if (grid->joint(sample(i)) == grid->joint(other.sample(j))) return true;
  return false;
}

bool SurfaceCell::gives(const std::array<int, 2>& feature, int half) const {
  if (half == 1 && has_all(grid->triangle(cell, 0), feature)) return false;
  for (int corner = 0; corner < 4; ++corner)
    if (is_edge(feature, {sample(corner), sample(corner)})) return owns(corner);
  for (int number = 0; number < CellFeatures::edges; ++number)
    if (is_edge(feature, edge(number))) return owns_edge(number);
  return false;
}

Vec3d ContactSide::mean(const Planes3& planes) const {
  Vec3d sum;
  for (std::size_t k = 0; k < 3; ++k)
    if (weights[k] != 0) sum += weights[k] * vec_cast<double>(planes.at(samples[k]));
  return sum;
}

double ContactSide::compliance() const {
  PointCompliance total;
  const int n = cloth->start.size();
  for (std::size_t k = 0; k < 3; ++k)
    if (weights[k] != 0) total.add(weights[k], cloth->inverse_mass(samples[k] / n, samples[k] % n));
  return total.value();
}

std::array<int, 2> ContactSide::feature() const {
  std::array<int, 2> found{-1, -1};
  for (std::size_t k = 3; k-- > 0;)
    if (weights[k] > 0) found = {samples[k], found[0] < 0 ? samples[k] : found[0]};
  return found;
}

double samples_between(const SurfaceGrid& grid, const ContactSide& a, const ContactSide& b) {
  if (!grid.same_chart(a.samples[0], b.samples[0])) return HUGE_VAL;
  double rows = 0, cols = 0;
  const auto add = [&](const ContactSide& side, double sign) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int row = side.samples[k] / grid.size(), col = side.samples[k] % grid.size();
      rows += sign * side.weights[k] * row;
      cols += sign * side.weights[k] * col;
    }
  };
  add(a, 1);
  add(b, -1);
  return std::max(std::abs(rows), std::abs(cols));
}

/// Whether a sample is of the feature.
bool FeatureRing::has(int sample) const {
  const int point = grid_->point(sample);
  return point == grid_->point(feature_[0]) || point == grid_->point(feature_[1]);
}

/// Whether a test holds for one of the triangles.
template <class Test>
bool FeatureRing::any(const Test& test) const {
  int sample = feature_[0];
  do {
    if (any_beside(sample, test)) return true;
    sample = grid_->next_copy(sample);
  } while (sample != feature_[0]);
  return false;
}

/// The same of those that have one of its samples.
template <class Test>
bool FeatureRing::any_beside(int sample, const Test& test) const {
  const int n = grid_->size(), row = sample / n, col = sample % n;
  const int corners = feature_[0] == feature_[1] ? 1 : 2;
  for (int r = std::max(0, row - 1); r < std::min(n - 1, row + 1); ++r)
    for (int c = std::max(0, col - 1); c < std::min(n - 1, col + 1); ++c)
      for (int half = 0; half < 2; ++half) {
        const std::array<int, 3> triangle = grid_->triangle(r, c, half);
        if (grid_->folded(triangle) || std::count_if(triangle.begin(), triangle.end(),
                                                     [&](int s) { return has(s); }) < corners)
          continue;
        if (test(triangle, corners_at(*at_, triangle))) return true;
      }
  return false;
}

bool FeatureRing::is_closest_to(Vec3d point) const {
  return !any([&](const std::array<int, 3>& samples, const std::array<Vec3d, 3>& corners) {
    const std::array<double, 3> weights = closest_weights(point, corners);
    for (std::size_t k = 0; k < 3; ++k)
      if (weights[k] > 0 && !has(samples[k])) return true;
    return false;
  });
}

bool FeatureRing::faces(Vec3d direction) const {
  return any([&](const std::array<int, 3>& /*samples*/, const std::array<Vec3d, 3>& corners) {
    const Vec3d normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double along = dot(normal, direction);
    return along * along > squared_steep * squared_length(normal) * squared_length(direction);
  });
}

}  // namespace weft
