#pragma once

#include <span>

#include "weft/param/collapse_hierarchy.h"
#include "weft/param/stretch.h"

namespace weft {

/// A valid map of what is left of a disk, whose vertices move one at a time.
struct LocalMap {
  const CollapseHierarchy& mesh;
  std::span<const SurfaceTriangle> surface;  ///< [F] of the triangles as they are now
  std::span<Vec2d> uv;                       ///< [D]
};

/// Moves one inner vertex to lower stretch of the triangles around it, by a projected Newton step
/// in its two coordinates. The move ends before the first of them closes, and every one is checked
/// by exact arithmetic, so a valid map stays valid.
/// @return whether the vertex moved
bool improve_vertex(const LocalMap& map, int vertex);

/// Moves one inner vertex into the midst of the kernel of its neighbours where that lowers the
/// stretch: a vertex in a crevice, from which Newton steps would take long to climb, gets out at
/// once.
bool centre_vertex(const LocalMap& map, int vertex);

/// improve_vertex for all inner vertices once, in order.
void sweep(const LocalMap& map);

}  // namespace weft
