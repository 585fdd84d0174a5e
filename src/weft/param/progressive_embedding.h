#pragma once

#include <span>

#include "weft/cut/disk_mesh.h"
#include "weft/progress.h"

namespace weft {

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
