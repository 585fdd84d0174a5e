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
  /// How much farther apart a pair that is reported may be. Never taken finer than rounding allows:
  /// 2^-46 of the pair's extent. [m]
  double tolerance = 1e-12;
  /// How far each coordinate may be from the one that is meant, when it was rounded. [m]
  double input_error = 0;
  int max_steps = 100000;  ///< after so many the pair counts as colliding where it stands
};

/// Where a moving pair has come as near as it may.
struct Impact {
  double time = 0;  ///< in 0 .. 1; before it the pair is farther apart than the separation
  /// The nearest points: of edges their places along the first and the second; of a triangle the
  /// weights of its second and third corner, the first corner having the rest.
  double u = 0, v = 0;
  double distance = 0;  ///< of those points at that time, no less than it really is [m]
  int steps = 0;        ///< that were taken to find it
};

/// The first time at which a pair comes near while every corner moves in a straight line from
/// `start` to `end`. Conservative: what comes as near as the separation is always reported, at a
/// time that is not after it does, whatever the rounding. What is reported comes as near as
/// separation + tolerance (+ what the input's error adds), unless the steps ran out: `distance`
/// tells.
/// @return nothing when the pair stays apart
/// @pre finite coordinates below 1e100
///
/// For every time the differences between points of the one and points of the other fill a
/// triangle or a parallelogram, whose corners move in straight lines too. A plane that keeps it
/// from the origin now is passed by each corner at a time that is a division away; up to the least
/// of them the pair is apart, and there the nearest point gives the next plane. So time advances as
/// in [mirtich96], but along planes, which parallel motion does not slow down, and every comparison
/// is against a bound of its rounding.
std::optional<Impact> time_of_impact(const VertexFace& start, const VertexFace& end,
                                     const CcdOptions& options = {}) noexcept;
std::optional<Impact> time_of_impact(const EdgeEdge& start, const EdgeEdge& end,
                                     const CcdOptions& options = {}) noexcept;

}  // namespace weft
