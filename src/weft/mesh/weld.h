#pragma once

#include <span>
#include <vector>

#include "weft/mesh.h"
#include "weft/mesh/topology.h"

namespace weft {

/// The first vertex at the position of each. [V]
std::vector<int> first_at_position(std::span<const Vec3d> positions);

/// What welding a surface's vertices at exactly equal positions makes of it.
struct Welding {
  std::vector<int> first;          ///< [V] the first vertex at the position of each
  std::size_t closed_borders = 0;  ///< edges of one triangle that have a second one then
};

/// Files without indices, and with vertices repeated at texture seams, leave a surface in parts
/// that belong together.
/// @param edges  of the mesh's triangles
/// @return nothing to do (`first` empty) where no border closes, or where edges of more than two
///         triangles would come about, as between bodies that touch
Welding find_welding(const TriangleMesh& mesh, const EdgeUses& edges);

/// Joins vertices. @param first  of find_welding  @post triangles may repeat a vertex
void weld(std::span<Triangle> triangles, std::span<const int> first);

}  // namespace weft
