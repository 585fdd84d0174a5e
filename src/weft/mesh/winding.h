#pragma once

#include <span>
#include <vector>

#include "weft/mesh/box_tree.h"

namespace weft {

/// Whether a surface is closed and oriented: every edge is run along as often in one direction as
/// in the other. @param triangles  corners by vertex, joined where they are one point
bool is_closed(std::span<const Triangle> triangles);

/// Tells how often a closed, oriented surface winds around a point. Unlike a closest normal this
/// needs no surface that is free of crossings.
class WindingNumbers {
 public:
  /// @pre finite corners, here and below
  explicit WindingNumbers(std::vector<Corners> triangles);
  /// The triangles for writing new corners into, [F]; `moved` must follow.
  [[nodiscard]] std::span<Corners> triangles() { return triangles_; }
  void moved() noexcept { tree_.fit_boxes(triangles_); }

  /// 1 inside of a surface whose normals point outwards, -1 of one that is turned inside out, 0
  /// outside. Triangles straight above count, by their directions. Every decision is exact for the
  /// doubles as they are; where the ray meets an edge it is the one beside it that is asked, the
  /// same for all triangles. A point on the surface may count as either.
  [[nodiscard]] int at(Vec3d point) const;

 private:
  [[nodiscard]] int count_below(int node, Vec3d point) const;

  std::vector<Corners> triangles_;
  BoxTree tree_;
};

}  // namespace weft
