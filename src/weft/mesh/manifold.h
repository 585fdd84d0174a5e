#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "weft/mesh.h"
#include "weft/mesh/topology.h"

namespace weft {

/// Flips triangles until neighbours run along their shared edge in opposite directions; the
/// orientation of the majority in each component stays. @pre manifold edges
/// @return how many were flipped
/// @throws TopologyError naming an edge where that is impossible
int orient_triangles(std::span<Triangle> triangles, const EdgeUses& edges,
                     std::string_view mesh_name);

/// The same for surfaces that cannot be oriented, and edges of any number of triangles: where
/// neighbours still run along their edge in one direction, the surface is to be parted there.
/// @param parted  [E] set to whether the surface is parted at an edge: those of more than two
///                triangles, and those
/// @return how many triangles were flipped
int orient_parts(std::span<Triangle> triangles, const EdgeUses& edges, std::vector<bool>& parted);

/// The result of split_fans, which gives every fan of triangles around a vertex its own copy of the
/// vertex; copies come last.
struct VertexSplit {
  std::vector<int> source_vertex;  ///< [V] the original of each vertex
  int split_vertices = 0;          ///< number of vertices with more than one fan
  int fans = 0;                    ///< total number of their fans
};
/// @pre manifold edges, consistent orientation
VertexSplit split_fans(int vertex_count, std::span<Triangle> triangles);

/// A surface parted at edges.
struct PartedVertices {
  std::vector<int> source_vertex;  ///< [V] the original of each vertex; copies come last
  /// [V] vertices of the same number are one point of the surface, joined by a parted edge.
  std::vector<int> joined;
};
/// Gives every fan of triangles around a vertex its own copy of the vertex, where a fan ends at
/// parted edges. @param edges  of the triangles as they are  @param parted  [E]
/// @pre edges that are not parted have one triangle, or two of consistent orientation
/// @post a parted edge both ends of which lie inside of one fan stays whole; see lengthen_slits
PartedVertices part_vertices(int vertex_count, std::span<Triangle> triangles, const EdgeUses& edges,
                             const std::vector<bool>& parted);

/// A parted edge inside of a piece, both ends of which are inside too, opens nothing: parts an edge
/// beside each such one as well, the one that goes on most straightly.
/// @param parted  [E] of the same edges
void lengthen_slits(const TriangleMesh& mesh, const EdgeUses& edges, std::vector<bool>& parted);

}  // namespace weft
