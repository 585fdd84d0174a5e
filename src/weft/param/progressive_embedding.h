#pragma once

#include <functional>
#include <limits>
#include <span>

#include "weft/cut/disk_mesh.h"
#include "weft/param/border_relaxation.h"
#include "weft/param/collapse_hierarchy.h"
#include "weft/param/vertex_star.h"
#include "weft/progress.h"

namespace weft {

struct ReinsertionOptions {
  /// Energy of the triangle with the given vertices, by which the map is relaxed.
  std::function<StarTriangle(const Triangle&)> triangle;
  double growth = 1.3;  ///< of the number of triangles from one round of sweeps to the next
  int sweeps = 2;       ///< per round
  /// Of more triangles, twice the sweeps, over what is not at rest.
  int many = std::numeric_limits<int>::max();
  std::span<const BorderFreedom> freedoms = {};  ///< border vertices relaxed too
  int threads = 1;
  Progress* progress = nullptr;
};

/// Reinserts all collapsed vertices into a valid map, each inside the kernel of its neighbours
/// [shen19]. That kernel is never empty in exact arithmetic; where it is in doubles, the
/// neighbourhood is first relaxed without the vertex, over more and more rings. Between rounds all
/// vertices are relaxed, so that triangles stay well shaped.
/// @param uv  [D] a valid map of the vertices present
/// @return whether all vertices were reinserted; if not, the map of those present is valid
bool bring_back(CollapseHierarchy& mesh, std::span<Vec2d> uv, const ReinsertionOptions& options);

/// Maps the interior of a disk into a convex border independently of the surface's geometry: the
/// disk is reduced to a wheel (weft/param/collapse_hierarchy.h), which is a valid map with its hub
/// at the centre of the border; then all vertices are reinserted one by one, each inside the kernel
/// of its neighbours [shen19]. In between, triangles are relaxed towards equilateral ones of one
/// size, so that doubles suffice whatever slivers the surface has. [shen19] collapses only
/// around flipped triangles of an initial map; the wheel needs no initial map.
/// @param uv  [D] positions of the border vertices given, counter-clockwise on a convex polygon,
/// all distinct, three of them not on one line; the rest is overwritten
/// @pre no chords
/// @return whether a valid map was found
bool embed_progressively(const DiskMesh& disk, std::span<Vec2d> uv, Progress* progress);

}  // namespace weft
