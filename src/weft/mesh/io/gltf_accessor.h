#pragma once

#include <vector>

#include "weft/mesh/io/gltf_buffers.h"
#include "weft/vec.h"

namespace weft {

/// Reads the positions of an accessor: floats, or integers of KHR_mesh_quantization.
/// @param index  @pre below root.count("accessors")
/// @throws InputError for data out of the buffer's range, of another type, or sparse
std::vector<Vec3d> read_gltf_positions(const GltfObject& root, GltfBuffers& buffers, int index);

/// Reads the texture coordinates of an accessor, v upwards as in OBJ; in glTF it runs downwards.
/// @throws InputError the same, also for a count that is not `vertices`
std::vector<Vec2f> read_gltf_texture(const GltfObject& root, GltfBuffers& buffers, int index,
                                     std::size_t vertices);

/// Reads the vertex numbers of an accessor. @throws InputError, also for one that is not below
/// `vertices`
std::vector<int> read_gltf_indices(const GltfObject& root, GltfBuffers& buffers, int index,
                                   std::size_t vertices);

}  // namespace weft
