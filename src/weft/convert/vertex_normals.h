#pragma once

#include <vector>

#include "weft/cut/disk_mesh.h"

namespace weft {

/// Unit normals at the vertices of a disk, weighted by the triangles' angles there and summed over
/// all disk vertices that are one point of the surface: mates get the same bits. A vertex whose
/// triangles have no area gets the normal (0, 1, 0). [D]
std::vector<Vec3d> disk_vertex_normals(const DiskMesh& disk);

}  // namespace weft
