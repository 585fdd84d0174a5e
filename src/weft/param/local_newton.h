#pragma once

#include <span>
#include <vector>

#include "weft/param/border_relaxation.h"
#include "weft/param/vertex_star.h"

namespace weft {

/// Moves single vertices of what is left of a disk to lower L2 stretch of the triangles around
/// them, by Newton steps in their own one or two coordinates with the true Hessian where that is
/// positive. A step ends before the first triangle closes and every one is checked by exact
/// arithmetic, so a valid map stays valid.
class VertexMover {
 public:
  /// Keeps references to all of them.
  /// @param triangles  [F] as they are now
  /// @param uv         [D] a valid map
  VertexMover(const CollapseHierarchy& mesh, std::span<const StarTriangle> triangles,
              std::span<Vec2d> uv)
      : mesh_(mesh), triangles_(triangles), uv_(uv) {}

  /// Moves an inner vertex. @return whether it moved
  bool improve(int vertex);
  /// Moves an inner vertex into the midst of the kernel of its neighbours where that lowers the
  /// energy: out of a crevice at once, from which Newton steps would take long to climb.
  bool centre(int vertex);
  /// Moves a border vertex along its side, and its mate with it.
  bool improve(const BorderFreedom& freedom);
  /// Moves all inner vertices and all freedoms once, in order.
  void sweep(std::span<const BorderFreedom> freedoms = {});

 private:
  const CollapseHierarchy& mesh_;
  std::span<const StarTriangle> triangles_;
  std::span<Vec2d> uv_;
  VertexStar star_, mate_star_;
};

}  // namespace weft
