#pragma once

#include <span>
#include <vector>

#include "weft/mesh/box_tree.h"

namespace weft {

/// Whether a surface is closed and oriented: every edge has as many half-edges in one direction as
/// in the other. @param triangles  corners by vertex, joined where they are one point
bool is_closed(std::span<const Triangle> triangles);

/// The direction of a ray: along an axis (0 to 2), or against it.
struct RayAxis {
  int axis = 1;
  bool down = false;
};

/// Winding numbers of a closed, oriented surface. Unlike the normal at the closest point they tell
/// inside from outside also where the surface crosses itself.
class WindingNumbers {
 public:
  /// @pre finite corners, here and below
  explicit WindingNumbers(std::vector<Corners> triangles);
  /// The triangles for writing new corners into, [F]; `moved` must follow.
  [[nodiscard]] std::span<Corners> triangles() { return triangles_; }
  void moved() noexcept;

  /// The winding number of a point: 1 inside of a surface whose normals point outwards, -1 of an
  /// inverted one, 0 outside. Sums the signs of the triangles that a ray along the axis along which
  /// the surface is thinnest meets. Every decision is exact for the doubles as they are; a ray that
  /// meets an edge is perturbed alike for all triangles. A point on the surface may count as
  /// either.
  /// @param towards  where the ray goes rather than back: the way out, where that is known
  [[nodiscard]] int at(Vec3d point, Vec3d towards = {1, 1, 1}) const;

 private:
  [[nodiscard]] int count_along(RayAxis ray, int node, Vec3d point) const;

  std::vector<Corners> triangles_;
  BoxTree tree_;
  int up_ = 1;  // axis
};

}  // namespace weft
