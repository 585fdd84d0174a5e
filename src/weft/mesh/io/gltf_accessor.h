#pragma once

#include <vector>

#include "weft/mesh/io/gltf_buffers.h"
#include "weft/vec.h"

namespace weft {

/// The positions that an accessor lists; whole numbers as KHR_mesh_quantization has them.
/// @param index  @pre below root.count("accessors")
/// @throws InputError for data out of the buffer's range, of another type, or sparse
std::vector<Vec3d> read_gltf_positions(const GltfObject& root, GltfBuffers& buffers, int index);

/// The texture coordinates that an accessor lists, v upwards as in OBJ: glTF counts it downwards.
/// @throws InputError the same, also for a count that is not `vertices`
std::vector<Vec2f> read_gltf_texture(const GltfObject& root, GltfBuffers& buffers, int index,
                                     std::size_t vertices);

/// The vertex numbers that an accessor lists. @throws InputError, also for one that is not below
/// `vertices`
std::vector<int> read_gltf_indices(const GltfObject& root, GltfBuffers& buffers, int index,
                                   std::size_t vertices);

}  // namespace weft
