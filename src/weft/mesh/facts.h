#pragma once

#include <array>
#include <vector>

#include "weft/mesh/triangle_mesh.h"

namespace weft {

/// What decides a mesh's fate, for any mesh, broken ones too; nothing is repaired.
struct MeshFacts {
  int vertices = 0, triangles = 0;
  int components = 0;            ///< joined through shared edges
  int border_edges = 0;          ///< edges of one triangle
  int nonmanifold_edges = 0;     ///< edges of more than two
  int nonmanifold_vertices = 0;  ///< vertices whose triangles form more than one fan
  int inconsistent_edges = 0;    ///< edges that both triangles run along in the same direction
  bool orientable = true;    ///< two triangles meet at an edge consistently after turning some over
  int slivers = 0;           ///< triangles with 4 sqrt(3) area / (sum of squared edges) below 0.01
  double least_quality = 1;  ///< the least of that figure: 1 for an equilateral triangle
  std::vector<int> nonmanifold_vertex_list;               ///< ascending
  std::vector<std::array<int, 2>> nonmanifold_edge_list;  ///< ascending
};
/// @pre indices in range
MeshFacts examine_mesh(const TriangleMesh& mesh);

/// 4 sqrt(3) area / (sum of squared edge lengths): 1 equilateral, 0 degenerate.
double triangle_quality(Vec3d a, Vec3d b, Vec3d c);

}  // namespace weft
