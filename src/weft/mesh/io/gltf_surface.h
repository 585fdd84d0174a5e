#pragma once

#include <vector>

#include "weft/mesh.h"
#include "weft/mesh/io/gltf_colours.h"
#include "weft/mesh/io/gltf_document.h"

namespace weft {

/// Vertices of a GltfSurface that come from the positions of one primitive where a node places
/// them.
struct GltfBlock {
  int node = -1;  ///< -1 in a file without nodes
  int mesh = 0, primitive = 0;
  int base = 0, count = 0;  ///< vertices [base, base + count)
};

/// The triangles of a file's default scene at rest, in the order of its nodes and primitives.
/// Primitives of a mesh that share their positions, and all that moves them, share a block.
struct GltfSurface {
  TriangleMesh mesh;
  std::vector<GltfBlock> blocks;  ///< by ascending vertices, without gaps
};

/// @param colours  receives those of the triangles, or null: pictures are then left alone
/// @throws InputError for a file without triangles, or whatever in it is wrong
GltfSurface read_gltf_surface(GltfDocument& document, GltfColours* colours = nullptr);

}  // namespace weft
