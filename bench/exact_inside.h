#pragma once

#include <vector>

#include "weft/mesh/box_tree.h"

namespace weft::bench {

/// Which points lie inside a closed surface, by rays whose every decision is exact.
class ExactInside {
 public:
  explicit ExactInside(const TriangleMesh& mesh)
      : triangles_(corners_of(mesh)), tree_(triangles_) {}

  enum class Side { inside, outside, unclear };
  /// Counts the triangles straight above. Unclear where the ray touches an edge or the point lies
  /// on a triangle.
  [[nodiscard]] Side side_of(Vec3d point) const;

 private:
  /// @return false where something is unclear
  bool count(Vec3d point, int node, int& crossings) const;

  std::vector<Corners> triangles_;
  BoxTree tree_;
};

}  // namespace weft::bench
