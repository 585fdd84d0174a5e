#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "weft/cut.h"
#include "weft/cut/open_to_disk.h"

namespace weft {

/// The same from memory; `name` is what errors call it.
Seam parse_seam(std::string_view bytes, std::string_view name);

/// A cut along a seam.
struct SeamCut {
  Cut cut;
  int added_edges = 0;  ///< beyond the seam, because it does not open the mesh to a disk
};
/// The seam's edges, and further ones where these do not open the mesh to a disk.
/// @param mesh           repaired
/// @param source_vertex  [V] the seam's number for each vertex; several may have the same
/// @param options        of the further ones
/// @throws InputError with the seam's FILE:LINE for a vertex that is not in the mesh, or a path
///         that cuts the surface in pieces
SeamCut cut_along_seam(const TriangleMesh& mesh, std::span<const int> source_vertex,
                       const Seam& seam, const CutOptions& options = {});

}  // namespace weft
