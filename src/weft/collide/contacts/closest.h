#pragma once

#include <array>

#include "weft/grid.h"
#include "weft/vec.h"

namespace weft {

/// Corners of a convex feature: a point, a segment or a triangle.
struct Feature {
  std::array<Vec3d, 3> corners;
  int count = 3;
};

/// The closest points of two features, as weights of their corners.
struct ClosestPair {
  double squared_distance = HUGE_VAL;  ///< [m^2]
  std::array<double, 3> weights_a{}, weights_b{};
  Vec3d a, b;  ///< the points [m]
};

/// Closest points of two disjoint features, by the closest of their points, edges and triangles
/// [ericson04, chapter 5]. Of several equally close pairs the first found. Where the features
/// intersect, the pair of an edge and a triangle that do may be missed: the distance is then that
/// of the boundaries, not zero.
ClosestPair closest_points(const Feature& a, const Feature& b);

/// The places of a triangle's samples. [m]
std::array<Vec3d, 3> corners_at(const Planes3& positions, const std::array<int, 3>& samples);
/// The mean of three corners by weights that sum to 1.
Vec3d blend(const std::array<Vec3d, 3>& corners, const std::array<double, 3>& weights);
/// Weights of the point of a triangle that is closest to p, >= 0, sum 1.
std::array<double, 3> closest_weights(Vec3d p, const std::array<Vec3d, 3>& triangle);

}  // namespace weft
