#pragma once

#include <vector>

#include "weft/image/geometry_image.h"
#include "weft/mesh/triangle_mesh.h"

namespace weft {

/// The samples of a grid as a mesh: each quad split along its shorter diagonal (at the border as
/// the topology wants, weft/image/diagonals.h), mates joined, triangles with a repeated vertex left
/// out.
struct RebuiltMesh {
  TriangleMesh mesh;           ///< world positions
  std::vector<int> vertex_of;  ///< [n * n] mesh vertex of every sample. A corner of the square
                               ///< between two mates lies in no triangle (its quad is folded onto
                               ///< itself): it has its neighbours' vertex
  std::vector<int> sample_of;  ///< [V] the representative sample of every vertex, ascending
};
RebuiltMesh rebuild_mesh(const GeometryImage& image);

/// The triangulation of the grid that everything shares (rebuilding, drawing, colliding, checking),
/// for positions that may have moved since: the triangles of `rebuild_mesh`, in the same order, as
/// sample indices, mates not joined. Counter-clockwise in the square, u to the right and v up.
std::vector<Triangle> grid_triangles(const GeometryImage& image);

}  // namespace weft
