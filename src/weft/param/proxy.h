#pragma once

#include <vector>

#include "weft/cut/open_to_disk.h"

namespace weft {

/// A coarser mesh of the same topology with the same cut on it.
struct Proxy {
  TriangleMesh mesh;
  Cut cut;
  std::vector<int> source_vertex;  ///< [V'] the vertex of the fine mesh at the same place
};

/// Coarsens a mesh to about so many triangles by collapsing short edges onto one of their ends, as
/// far as the topology (link condition), the normals of the triangles and the course of cut and
/// border allow: vertices of cut and border only move along these, and nodes stay. Positions do not
/// change, so each vertex is one of the fine mesh.
/// @pre repaired mesh
Proxy coarsen(const TriangleMesh& mesh, const Cut& cut, int triangles);

}  // namespace weft
