#pragma once

#include <vector>

#include "weft/mesh.h"
#include "weft/mesh/topology.h"
#include "weft/repair.h"

namespace weft {

// Where to part a surface into charts. Edges of two triangles alone are looked at; those that are
// parted already stay so.

/// Parts it where two triangles have different texture coordinates at their common edge.
/// @param mesh    with corner_uv  @param parted  [E]
/// @return how many edges were added
int part_at_texture_seams(const TriangleMesh& mesh, const EdgeUses& edges,
                          std::vector<bool>& parted);

/// Parts it into regions that are compact and nearly flat, by Lloyd's method on triangles: regions
/// grow from their seeds, and each gets as its seed the triangle farthest from its border
/// [sander03].
/// @param choice  of so many regions in all; each connected part of the surface is one at least
/// @param parted  [E]
/// @return how many regions there are
int part_in_regions(const TriangleMesh& mesh, const EdgeUses& edges, const PartChoice& choice,
                    std::vector<bool>& parted);

}  // namespace weft
