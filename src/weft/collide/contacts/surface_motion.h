#pragma once

#include <span>
#include <vector>

#include "weft/core/planes.h"
#include "weft/mesh/triangle_mesh.h"

namespace weft {

/// How the points of a body's surface move in a step, as what is before it sees them. Normals are
/// means of the triangles around a point by their areas: slivers, as images have some, count
/// little.
class SurfaceMotion {
 public:
  /// @param triangles  by samples that stand for their classes
  void measure(const Planes3& start, const Planes3& end, std::span<const Triangle> triangles);
  /// How far a point comes closer to what is before it, or leaves: its way along the mean of its
  /// normals at both ends. What slides along itself, as a ball that turns in place, does not. [m]
  [[nodiscard]] double approach(int sample) const;
  /// How much its normal turns: nearly the angle, as long as it is small. [rad]
  [[nodiscard]] double turn(int sample) const;

 private:
  struct Point {
    Vec3d way, from, to;
  };
  std::vector<Point> points_;  // [n * n]
};

}  // namespace weft
