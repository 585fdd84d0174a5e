#pragma once

#include "weft/mesh_statistics.h"

namespace weft {

/// The part of a mesh's statistics that is about how its triangles hang together: components,
/// borders, non-manifold places, orientation.
/// @param mesh  finite; no triangle with a repeated vertex
void examine_surface(const TriangleMesh& mesh, MeshStatistics& statistics);

}  // namespace weft
