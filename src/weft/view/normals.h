#pragma once

#include <vector>

#include "weft/geometry_image.h"
#include "weft/grid.h"
#include "weft/mesh.h"

namespace weft {

/// Unit normals of a grid that moved: at each sample the sum of the vector areas of the quads
/// around it, added up over its mates, so that shading is smooth across seams. Zero where there is
/// no area.
/// @param positions  [n x n], finite
/// @param mates      of the same n, or null
Planes3 grid_normals(const Planes3& positions, const BorderMates* mates);

/// A mesh ready to be shaded: vertices where triangles meet at a sharp edge are there more than
/// once.
struct ShadedMesh {
  std::vector<Vec3f> positions;     ///< the first ones are the mesh's own vertices, in its order
  std::vector<Vec3f> normals;       ///< unit, weighted by area; zero where there is no area
  std::vector<Triangle> triangles;  ///< the mesh's, with indices renewed
  std::vector<int> source;          ///< the mesh's vertex of each
};
/// Smooth normals but for edges sharper than 50 degrees.
/// @pre triangles' indices are vertices
ShadedMesh shade_mesh(const TriangleMesh& mesh);

}  // namespace weft
