#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "weft/cut.h"
#include "weft/cut/open_to_disk.h"

namespace weft {

/// Parses a seam file held in memory; `name` stands for the file in errors.
Seam parse_seam(std::string_view bytes, std::string_view name);

/// A cut along a seam.
struct SeamCut {
  Cut cut;
  int added_edges = 0;  ///< edges beyond the seam, needed to open the mesh to a disk
};
/// Cuts along the seam's edges, and along further ones where these do not open the mesh to a disk.
/// @param mesh           repaired
/// @param source_vertex  [V] number of each vertex in the seam's file; repair may give several
///                       vertices the same
/// @param options        for the further edges
/// @throws InputError with the seam's FILE:LINE for a vertex that is not in the mesh, or a path
///         that cuts the surface in pieces
SeamCut cut_along_seam(const TriangleMesh& mesh, std::span<const int> source_vertex,
                       const Seam& seam, const CutOptions& options = {});

}  // namespace weft
