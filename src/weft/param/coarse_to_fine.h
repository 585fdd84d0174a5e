#pragma once

#include <functional>
#include <span>
#include <vector>

#include "weft/cut/disk_mesh.h"
#include "weft/param/border_relaxation.h"
#include "weft/progress.h"

namespace weft {

/// A disk whose vertices and triangles are numbered so that neighbours lie near each other in
/// memory. What walks over a surface too large for the caches then waits for memory far less.
struct OrderedDisk {
  DiskMesh disk;            ///< without surface triangles and splits
  std::vector<int> vertex;  ///< [D] index in the disk that was ordered
};

/// Triangles breadth first from the border's first edge, vertices as those come to them.
OrderedDisk breadth_first(const DiskMesh& disk);

/// Freedoms of another numbering. @param number  [D] of each vertex its new index
std::vector<BorderFreedom> renumbered(std::span<const BorderFreedom> freedoms,
                                      std::span<const int> number);

/// Maps the interior of a disk into a given convex border; border vertices with a freedom may move.
/// @return whether the map is valid
using MapDisk = std::function<bool(const DiskMesh&, std::span<Vec2d> uv,
                                   std::span<const BorderFreedom> freedoms)>;

struct CoarseToFineOptions {
  int triangles = 5000;  ///< about the size of the coarse disk; more where its border is long
  double growth = 1.6;   ///< of the number of triangles from one round of sweeps to the next
  int sweeps = 8;        ///< per round
  /// A disk of more triangles than this is renumbered, and sweeps over so many pass over vertices
  /// at rest: it does not fit into the processor's caches, and its finest levels converge at once
  /// but for a few places.
  int many = 200000;
  std::span<const BorderFreedom> freedoms = {};
  int threads = 1;
  Progress* progress = nullptr;
};

/// Maps a coarse version of a disk, with the same border, and refines that map: round by round,
/// vertices are reinserted and all vertices relaxed to minimise the stretch of the triangles around
/// them, as in [sander01]. Low frequencies of the map converge where there are few unknowns and
/// high ones on the finer levels, so the time is in proportion to the mesh. Where the coarse
/// version has no valid map, a coarser one is tried.
/// @param uv   [D] border given; on success a valid map
/// @param map  maps the coarse disk
/// @pre no chords
/// @return whether a valid map was found
bool map_coarse_to_fine(const DiskMesh& disk, std::span<Vec2d> uv, const MapDisk& map,
                        const CoarseToFineOptions& options);

}  // namespace weft
