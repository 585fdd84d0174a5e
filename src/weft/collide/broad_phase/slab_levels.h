#pragma once

#include <vector>

#include "weft/collide/broad_phase/node_levels.h"
#include "weft/collide/kernels/collide_kernels.h"
#include "weft/collide/moving_surface.h"
#include "weft/core/thread_team.h"

namespace weft {

/// Slab of a node: the two planes across its mean normal at the start between which it lies, at
/// both ends of a step, relative to one of its samples.
struct Slab {
  Vec3f origin;
  Vec3f normal;  ///< nearly unit, or zero where the node has none
  float lower_start = 0, upper_start = 0, lower_end = 0, upper_end = 0;  ///< along it [m]
};

/// Slabs of the small nodes of a body. Surfaces are nearly flat at small scale, so cloth that rests
/// on them is culled by a few slabs instead of hundreds of triangle tests. Cells have none, as
/// pairs of cells are tested closely anyway.
class SlabLevels {
 public:
  SlabLevels() = default;
  explicit SlabLevels(int cells);
  /// To be called by every worker; ends with a barrier.
  void fit(const CollideKernels& kernels, const MovingSurface& surface, Worker& worker);
  /// Slab of a node; null where it has none.
  [[nodiscard]] const Slab* find(const Node& node) const {
    if (node.level < 1 || node.level > max_level || node.level > top()) return nullptr;
    return &levels_[static_cast<std::size_t>(node.level)][index_of(node)];
  }

 private:
  /// Coarser nodes are too bent for a slab to be worth its fitting.
  static constexpr int max_level = 3;
  [[nodiscard]] int top() const { return static_cast<int>(sides_.size()) - 1; }
  [[nodiscard]] std::size_t index_of(const Node& node) const {
    return static_cast<std::size_t>(node.row) * sides_[static_cast<std::size_t>(node.level)] +
           static_cast<std::size_t>(node.col);
  }
  /// Twice the area vector of a node's surface.
  [[nodiscard]] Vec3d area_of(const Planes3& at, const Node& node) const;
  void fit_node(const CollideKernels& kernels, const MovingSurface& surface, const Node& node);

  std::vector<int> sides_;
  std::vector<std::vector<Slab>> levels_;
  std::vector<std::vector<Vec3d>> areas_;  // as area_of
};

}  // namespace weft
