#pragma once

#include <functional>
#include <span>

#include "weft/cut/disk_mesh.h"
#include "weft/param/border_relaxation.h"
#include "weft/progress.h"

namespace weft {

/// Maps the inside of a disk into a convex border that is given, whose freedoms may move.
/// @return whether the map is valid
using MapDisk = std::function<bool(const DiskMesh&, std::span<Vec2d> uv,
                                   std::span<const BorderFreedom> freedoms)>;

struct CoarseToFineOptions {
  int triangles = 5000;  ///< of the coarse disk, about, if as many as its border takes
  double growth = 1.6;   ///< of the count of triangles from one round of sweeps to the next
  int sweeps = 8;        ///< in a round
  std::span<const BorderFreedom> freedoms = {};
  Progress* progress = nullptr;
};

/// Maps a coarse version of a disk, with the same border, and refines that map: vertices come back
/// and all settle at the least L2 stretch of the triangles around them, round by round, as
/// [sander01] do. Low frequencies of the map are found where there are few unknowns, high ones
/// where they live, so the time is in proportion to the mesh. Where the coarse version has no valid
/// map, a still coarser one is tried.
/// @param uv   [D] border given; on success a valid map
/// @param map  maps the coarse disk
/// @pre no chords
/// @return whether a valid map was found
bool map_coarse_to_fine(const DiskMesh& disk, std::span<Vec2d> uv, const MapDisk& map,
                        const CoarseToFineOptions& options);

}  // namespace weft
