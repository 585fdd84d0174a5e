#pragma once

#include <functional>
#include <span>

#include "weft/cut/disk_mesh.h"
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

/// Maps the inside of a disk into the square without looking at the surface: the disk is taken down
/// to a wheel (weft/param/collapse_hierarchy.h), whose hub in the midst of a convex border is a
/// valid map; then all vertices come back one by one, each inside the kernel of its neighbours
/// [shen19]. In between every triangle is drawn towards equal sides of one size for all, so that
/// doubles never run out of room, whatever slivers the surface has. The source goes down only where
/// triangles are flipped; from the wheel no start is needed.
/// @param uv  [D] positions of the border vertices given, counter-clockwise on a convex polygon,
/// all distinct, three of them not on one line; the rest is overwritten
/// @pre no chords
/// @return whether a valid map was found
bool embed_progressively(const DiskMesh& disk, std::span<Vec2d> uv, Progress* progress);

}  // namespace weft
