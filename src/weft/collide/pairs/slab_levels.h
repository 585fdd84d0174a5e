#pragma once

#include <vector>

#include "weft/collide/pairs/node_levels.h"
#include "weft/collide/surface.h"
#include "weft/core/thread_team.h"

namespace weft {

/// Between which two planes, across its mean normal, a node of a surface lies at both ends of a
/// step, seen from one of its samples.
struct Slab {
  Vec3f origin;
  Vec3f normal;  ///< nearly unit, or zero where the node has none
  float lower_start = 0, upper_start = 0, lower_end = 0, upper_end = 0;  ///< along it [m]
};

/// The slabs of all nodes: surfaces are nearly flat where one looks closely, so cloth that rests on
/// them is told apart by a few slabs instead of hundreds of triangles.
class SlabLevels {
 public:
  SlabLevels() = default;
  explicit SlabLevels(int cells);
  /// To be called by every worker; ends with a barrier.
  void fit(const MovingSurface& surface, Worker& worker);
  [[nodiscard]] const Slab& at(const Node& node) const {
    return levels_[static_cast<std::size_t>(node.level)][static_cast<std::size_t>(
        node.row * sides_[static_cast<std::size_t>(node.level)] + node.col)];
  }

 private:
  void fit_node(const MovingSurface& surface, const Node& node);
  Slab& slab(const Node& node) {
    return levels_[static_cast<std::size_t>(node.level)][static_cast<std::size_t>(
        node.row * sides_[static_cast<std::size_t>(node.level)] + node.col)];
  }

  std::vector<int> sides_;
  std::vector<std::vector<Slab>> levels_;
};

}  // namespace weft
