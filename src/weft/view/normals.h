#pragma once

#include <vector>

#include "weft/geometry_image.h"
#include "weft/grid.h"
#include "weft/mesh.h"

namespace weft {

/// Unit normals of a grid of positions: at each sample the sum of the vector areas of the adjacent
/// quads, added up over its mates, so that shading is smooth across seams. Zero where there is no
/// area.
/// @param positions  [n x n], finite
/// @param mates      of the same n, or null
Planes3 grid_normals(const Planes3& positions, const BorderMates* mates);

/// A mesh with normals for shading. A vertex on a sharp edge has several copies, each with a normal
/// of its own.
struct ShadedMesh {
  std::vector<Vec3f> positions;     ///< the mesh's own vertices in their order, then the copies
  std::vector<Vec3f> normals;       ///< unit, weighted by area; zero where there is no area
  std::vector<Triangle> triangles;  ///< the mesh's, with updated indices
  std::vector<int> source;          ///< index of each in the mesh
};
/// Computes smooth normals, except between triangles at a vertex whose normals differ by more than
/// 50 degrees.
/// @pre all indices of the triangles are valid
ShadedMesh shade_mesh(const TriangleMesh& mesh);

}  // namespace weft
