#include "weft/param/edge_queue.h"

#include <algorithm>
#include <cmath>

namespace weft {

namespace {

/// How much the two shorter sides together exceed the longest.
double slack(const std::array<double, 3>& s) {
  return std::min({s[0] + s[1] - s[2], s[1] + s[2] - s[0], s[2] + s[0] - s[1]});
}

}  // namespace

std::vector<std::array<double, 3>> floored_lengths(std::span<const Vec3d> positions,
                                                   std::span<const Triangle> triangles) {
  std::vector<std::array<double, 3>> sides(triangles.size());
  double total = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      sides[t][k] = length(positions[triangles[t][(k + 1) % 3]] - positions[triangles[t][k]]);
      total += sides[t][k];
    }
  const double mean =
      total / (3.0 * static_cast<double>(std::max<std::size_t>(triangles.size(), 1)));
  const double min_slack = mean > 0 ? 1e-5 * mean : 1.0;

  double raise = 0;
  for (const auto& s : sides) raise = std::max(raise, min_slack - slack(s));
  if (raise > 0)
    for (auto& s : sides)
      for (double& l : s) l += raise;
  return sides;
}

std::array<double, 3> half_angle_tangents(const std::array<double, 3>& sides) {
  // tan(A / 2) = r / (s - a) with the inradius r; the differences s - a are computed without the
  // cancellation of subtracting from the half perimeter s.
  const std::array<double, 3> rest = {0.5 * (sides[0] + sides[2] - sides[1]),
                                      0.5 * (sides[0] + sides[1] - sides[2]),
                                      0.5 * (sides[1] + sides[2] - sides[0])};
  const double half_perimeter = rest[0] + rest[1] + rest[2];
  const double inradius = std::sqrt(rest[0] * (rest[1] * rest[2] / half_perimeter));
  return {inradius / rest[0], inradius / rest[1], inradius / rest[2]};
}

}  // namespace weft
