#pragma once

#include "weft/geometry_image.h"
#include "weft/param/square_map.h"

namespace weft {

/// Stage 9: samples a mapped surface at the n x n integer points of the square. Interior samples
/// come from the triangle that covers them, by exact orientation and a top-left rule; border
/// samples are computed once per pair of mated paths and written to both.
/// @post mates_bit_equal
/// @throws TopologyError when an interior sample is not covered exactly once: the map is not valid
GeometryImage sample_image(const MappedDisk& mapped);

/// Unit normals of the surface (angle-weighted at its vertices, interpolated), sampled at size x
/// size points of the same square, independently of the size of the image. Mates hold the same bits
/// wherever both are samples, always when size - 1 is a multiple of n - 1.
NormalMap sample_normals(const MappedDisk& mapped, int size);

/// The mesh's own texture coordinates at the samples of the image, x = u, y = v, z = 0. Each comes
/// from the triangle that contains the sample, so that mates differ where a seam of the texture
/// runs along the cut.
/// @param surface  the mesh that was cut open, with texture coordinates
Planes3 sample_texture(const MappedDisk& mapped, const TriangleMesh& surface);

/// The number of triangles that cover each interior sample under the top-left rule, [n x n], border
/// samples 0: all ones when the map is valid. For tests and inspection.
Grid<int> coverage(const MappedDisk& mapped);

}  // namespace weft
