#pragma once

#include <functional>
#include <span>

#include "weft/param/border_relaxation.h"
#include "weft/param/collapse_hierarchy.h"
#include "weft/param/vertex_star.h"
#include "weft/progress.h"

namespace weft {

struct ReinsertionOptions {
  /// A triangle given by its vertices; its energy is what makes room.
  std::function<StarTriangle(const Triangle&)> triangle;
  double growth = 1.3;  ///< of the count of triangles from one round of sweeps to the next
  int sweeps = 2;       ///< in a round
  std::span<const BorderFreedom> freedoms = {};  ///< border vertices that move too
  Progress* progress = nullptr;
};

/// Brings all collapsed vertices back into a valid map, each inside the kernel of its neighbours
/// [shen19], where there always is room in real numbers; where doubles see none, the neighbourhood
/// is first relaxed without the vertex, in ever wider circles. Between rounds all vertices are
/// relaxed, so that room never runs out.
/// @param uv  [D] a valid map of what is left
/// @return whether all vertices are back; if not, the map of what is left is valid
bool bring_back(CollapseHierarchy& mesh, std::span<Vec2d> uv, const ReinsertionOptions& options);

}  // namespace weft
