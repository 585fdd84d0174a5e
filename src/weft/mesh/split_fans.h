#pragma once

#include <span>
#include <vector>

#include "weft/mesh.h"

namespace weft {

/// Gives every fan of triangles around a vertex its own copy of the vertex; copies come last.
struct VertexSplit {
  std::vector<int> source_vertex;  ///< [V] the vertex that each one was before
  int split_vertices = 0;          ///< how many had more than one fan
  int fans = 0;                    ///< that those have together
};
/// @pre manifold edges, consistent orientation
VertexSplit split_fans(int vertex_count, std::span<Triangle> triangles);

}  // namespace weft
