#pragma once

#include <array>
#include <vector>

#include "weft/core/planes.h"
#include "weft/core/vec.h"
#include "weft/mesh/triangle_mesh.h"

namespace weft {

/// The points of a set that stand out farthest to 134 sides: what a camera has to see, however many
/// points there are. No point of the set lies more than 2 percent of the set's size beyond them.
class Outline {
 public:
  Outline();
  /// No-op for a point that is not finite.
  void add(Vec3d point);
  void add(const Planes3& positions);
  void add(const TriangleMesh& mesh);
  void add(const Outline& other);
  /// [m]; empty when nothing was added
  [[nodiscard]] std::vector<Vec3d> points() const;
  /// The same turned all around the vertical line through the middle of their box.
  [[nodiscard]] std::vector<Vec3d> points_turning() const;

 private:
  static constexpr int side_count = 134;  // 128 on a spiral, and along the axes
  std::array<Vec3d, side_count> sides_;
  std::array<Vec3d, side_count> farthest_;
  std::array<double, side_count> distance_;
};

}  // namespace weft
