#pragma once

#include <array>
#include <optional>

#include "weft/vec.h"

namespace weft {

/// A vertex and a triangle at one moment. [m]
struct VertexFace {
  Vec3d vertex;
  std::array<Vec3d, 3> face;
};

/// Two edges at one moment. [m]
struct EdgeEdge {
  std::array<Vec3d, 2> first, second;
};

struct CcdOptions {
  double separation = 0;  ///< the pair collides when it comes this near [m]
  /// Tolerance of the reported distance: a reported pair may be farther apart than the separation
  /// by this much. At least 2^-46 of the pair's extent is used, as rounding requires. [m]
  double tolerance = 1e-12;
  /// Bound of the rounding error of each input coordinate. [m]
  double input_error = 0;
  int max_steps = 100000;  ///< after so many the pair counts as colliding at the time reached
};

/// Time of impact of a moving pair, and its nearest points at that time.
struct Impact {
  double time = 0;  ///< in 0 .. 1; before it the pair is farther apart than the separation
  /// Parameters of the nearest points: for two edges the positions along the first and the second;
  /// for a triangle the barycentric weights of its second and third corner.
  double u = 0, v = 0;
  double distance = 0;  ///< upper bound of the distance of those points at that time [m]
  int steps = 0;        ///< iterations taken
};

/// First time of impact of a pair whose corners move on straight lines from `start` to `end`.
/// Conservative: a pair that comes as near as the separation is always reported, at a time no later
/// than it does, whatever the rounding. A reported pair comes as near as separation + tolerance (+
/// what the input's error adds), unless the search ended early: `distance` tells.
/// @return nothing when the pair stays apart
/// @pre finite coordinates below 1e100
///
/// At every time the differences between points of one feature and points of the other fill a
/// triangle or a parallelogram, whose corners move on straight lines too. A plane that separates it
/// from the origin is reached by each corner at a time found by one division; up to the earliest of
/// these times the pair is apart, and there the nearest point gives the next plane. So time
/// advances as in [mirtich96], but along planes, so that parallel motion does not slow it down, and
/// every comparison is against a bound of its rounding error.
std::optional<Impact> time_of_impact(const VertexFace& start, const VertexFace& end,
                                     const CcdOptions& options = {}) noexcept;
std::optional<Impact> time_of_impact(const EdgeEdge& start, const EdgeEdge& end,
                                     const CcdOptions& options = {}) noexcept;

}  // namespace weft
