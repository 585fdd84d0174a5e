#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "weft/mesh.h"
#include "weft/mesh/edge_uses.h"

namespace weft {

/// Flips triangles until neighbours run along their shared edge in opposite directions; the
/// orientation of the majority in each component stays. @pre manifold edges
/// @return how many were flipped
/// @throws TopologyError naming an edge where that is impossible
int orient_triangles(std::span<Triangle> triangles, const EdgeUses& edges,
                     std::string_view mesh_name);

/// The result of split_fans, which gives every fan of triangles around a vertex its own copy of the
/// vertex; copies come last.
struct VertexSplit {
  std::vector<int> source_vertex;  ///< [V] the original of each vertex
  int split_vertices = 0;          ///< number of vertices with more than one fan
  int fans = 0;                    ///< total number of their fans
};
/// @pre manifold edges, consistent orientation
VertexSplit split_fans(int vertex_count, std::span<Triangle> triangles);

}  // namespace weft
