#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/mesh.h"

namespace weft {

using Corners = std::array<Vec3d, 3>;

/// The corners of every triangle, [F].
std::vector<Corners> corners_of(const TriangleMesh& mesh);

/// True when the closed boxes have a point in common.
inline bool overlap(const Box3d& a, const Box3d& b) {
  return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y &&
         b.lower.y <= a.upper.y && a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

/// A bounding volume hierarchy of boxes over triangles: a binary tree, split at the median along
/// the longest side of the box of their centres. The left child of a node is the next node.
struct BoxTree {
  struct Node {
    Box3d box;
    int right = -1;           ///< -1 in a leaf
    int first = 0, last = 0;  ///< the range of places below it
  };
  std::vector<Node> nodes;       ///< depth at most log2(F) + 1; none without triangles
  std::vector<int> triangle_at;  ///< [F] from place in the tree to triangle

  explicit BoxTree(std::span<const Corners> triangles);
  /// Refits the boxes to triangles that have moved; the hierarchy stays. Allocates nothing.
  void fit_boxes(std::span<const Corners> triangles) noexcept;

 private:
  void build(std::span<const Vec3d> centres, int first, int last);
};

}  // namespace weft
