#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "weft/mesh.h"
#include "weft/mesh/edge_uses.h"

namespace weft {

/// Turns triangles over until all that share an edge run along it in opposite directions; the
/// orientation that most triangles of each part have stays. @pre manifold edges
/// @return how many were turned
/// @throws TopologyError naming an edge where that is impossible
int orient_triangles(std::span<Triangle> triangles, const EdgeUses& edges,
                     std::string_view mesh_name);

/// Gives every fan of triangles around a vertex its own copy of the vertex; copies come last.
struct VertexSplit {
  std::vector<int> source_vertex;  ///< [V] the vertex that each one was before
  int split_vertices = 0;          ///< how many had more than one fan
  int fans = 0;                    ///< that those have together
};
/// @pre manifold edges, consistent orientation
VertexSplit split_fans(int vertex_count, std::span<Triangle> triangles);

}  // namespace weft
