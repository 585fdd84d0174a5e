#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "weft/mesh.h"
#include "weft/mesh/topology.h"

namespace weft {

/// [F] whether an earlier triangle has the same three vertices, in whatever order.
/// @pre no triangle has a repeated vertex
std::vector<bool> duplicate_triangles(std::span<const Triangle> triangles, const EdgeUses& edges);

/// Components of a mesh, whose triangles are connected by edges, the largest area first; of equal
/// areas the one with the smallest vertex first.
struct SurfaceParts {
  std::vector<int> part_of;  ///< [F]
  int count = 0;
};
SurfaceParts surface_parts(const TriangleMesh& mesh, const EdgeUses& edges);

/// [parts] whether a closed part is inside out. One that lies in the box of a closed part which
/// faces outward may be the wall of a hollow in it, and counts as right.
/// @param edges  also of the mesh before triangles were flipped
std::vector<bool> inside_out_parts(const TriangleMesh& mesh, const EdgeUses& edges,
                                   const SurfaceParts& parts);

/// @param mesh_name  what the error calls the mesh
/// @throws TopologyError with the number of edges that have more than two triangles, and the
///         vertices of the first
void require_manifold_edges(std::span<const Triangle> triangles, const EdgeUses& edges,
                            std::string_view mesh_name);

}  // namespace weft
