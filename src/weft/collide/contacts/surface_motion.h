#pragma once

#include <span>
#include <vector>

#include "weft/core/thread_team.h"
#include "weft/grid.h"
#include "weft/mesh.h"

namespace weft {

/// How the points of a body's surface move in a step, as what is before it sees them. Normals are
/// means of the triangles around a point by their areas: slivers, as images have some, count
/// little.
class SurfaceMotion {
 public:
  /// @param start, end  [n x n] [m]  @param triangles  by samples that stand for their classes
  void measure(const Planes3& start, const Planes3& end, std::span<const Triangle> triangles,
               ThreadTeam& team);
  /// How far a point comes closer to what is before it, or leaves: its way along the mean of its
  /// normals at both ends. What slides along itself, as a ball that turns in place, does not. [m]
  [[nodiscard]] double approach(int sample) const { return points_[sample].approach; }
  /// The same to what goes along by `way`, and what the slant of the triangles around may add as
  /// they slide past it.
  [[nodiscard]] double approach(int sample, Vec3d displacement) const;
  /// How much its normal turns: nearly the angle, as long as it is small. [rad]
  [[nodiscard]] double turn(int sample) const { return points_[sample].turn; }
  /// The mean of its normals at both ends, and not unit.
  [[nodiscard]] Vec3d normal(int sample) const { return points_[sample].normal; }
  /// How much the triangles around lean to its normal: the part of a slide that they may approach.
  [[nodiscard]] double slant(int sample) const { return points_[sample].slant; }

 private:
  struct Areas {
    Vec3d from, to;
    double size = 0;  // of `from`, or of those that were summed
  };
  struct Point {
    Vec3d displacement, normal;  // the mean of both ends'
    double approach = 0, turn = 0;
    double slant = 0;  // sine of what triangles lean to it, twice their root mean square
  };
  std::vector<Areas> triangles_;  // twice the area along the normal
  std::vector<Areas> sums_;       // [n * n]
  std::vector<Point> points_;     // [n * n]
};

}  // namespace weft
