#pragma once

#include <span>
#include <vector>

#include "weft/core/thread_team.h"
#include "weft/grid.h"
#include "weft/mesh.h"

namespace weft {

/// Motion of a body's surface in a step along its normals, as obstacles before it meet it. Normals
/// are means over the triangles around a point, weighted by area: slivers, as images have some,
/// count little.
class SurfaceMotion {
 public:
  /// Measures all points.
  /// @param start, end  [n x n] [m]
  /// @param triangles  corners as representative samples
  void measure(const Planes3& start, const Planes3& end, std::span<const Triangle> triangles,
               ThreadTeam& team);
  /// Approach of a point: the absolute value of its displacement along the mean of its normals at
  /// both ends. A surface that slides along itself, as a ball that turns in place, has none. [m]
  [[nodiscard]] double approach(int sample) const { return points_[sample].approach; }
  /// Approach of a point to one that moves by `displacement`, with what the slant of the triangles
  /// around it may add as they slide past. [m]
  [[nodiscard]] double approach(int sample, Vec3d displacement) const;
  /// Rotation of a point's normal in the step: nearly the angle, as long as it is small. [rad]
  [[nodiscard]] double turn(int sample) const { return points_[sample].turn; }
  /// Mean of a point's normals at both ends, not unit.
  [[nodiscard]] Vec3d normal(int sample) const { return points_[sample].normal; }
  /// Slant of the triangles around a point against its normal: the part of a sliding displacement
  /// by which they may approach.
  [[nodiscard]] double slant(int sample) const { return points_[sample].slant; }

 private:
  struct Areas {
    Vec3d from, to;
    double size = 0;  // of `from`, or of those that were summed
  };
  struct Point {
    Vec3d displacement, normal;  // the mean of both ends'
    double approach = 0, turn = 0;
    double slant = 0;  // sine of the triangles' tilt against it, twice the root mean square
  };
  std::vector<Areas> triangles_;  // twice the area along the normal
  std::vector<Areas> sums_;       // [n * n]
  std::vector<Point> points_;     // [n * n]
};

}  // namespace weft
