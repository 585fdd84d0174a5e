#pragma once

#include <vector>

#include "weft/mesh/io/gltf_buffers.h"
#include "weft/vec.h"

namespace weft {

/// Reads the numbers of an accessor, element by element; those of its `sparse` in place.
/// @param index  @pre below root.count("accessors")
/// @param width  components of an element: 1 to 4 (SCALAR, VEC2 .. VEC4), or 16 (MAT4 of floats)
/// @throws InputError for data out of the buffer's range, or of another type
std::vector<double> read_gltf_numbers(const GltfObject& root, GltfBuffers& buffers, int index,
                                      std::size_t width);

/// The same of whole numbers that count something, for which `normalized` has no meaning.
/// @throws InputError also for floats and signed numbers
std::vector<double> read_gltf_whole_numbers(const GltfObject& root, GltfBuffers& buffers, int index,
                                            std::size_t width);

/// Reads the positions of an accessor: floats, or integers of KHR_mesh_quantization.
/// @param index  @pre below root.count("accessors")
/// @throws InputError for data out of the buffer's range, of another type
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
