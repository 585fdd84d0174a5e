#pragma once

#include <span>
#include <vector>

#include "weft/geometry_image.h"
#include "weft/param/square_map.h"

namespace weft {

/// The similarity to the cube that holds positions, its lower corner at theirs.
WorldMap unit_cube_map(std::span<const Vec3d> positions);
/// A position in that cube, in [0, 1]^3 whatever rounding does.
Vec3f to_cube(const WorldMap& world, Vec3d position);
/// Gives samples that are one surface point the bits of their representative.
void join_mates(GeometryImage& image);

/// At each vertex the sum of its triangles' unit normals, weighted by their angles there. [V]
std::vector<Vec3d> angle_weighted_normals(std::span<const Vec3d> positions,
                                          std::span<const Triangle> triangles);

/// Unit normals at the vertices of a disk, weighted by the angles of the triangles there and summed
/// over all disk vertices of one surface point, so that mates get the same bits. A vertex whose
/// triangles have no area gets the normal (0, 1, 0). [D]
std::vector<Vec3d> disk_vertex_normals(const DiskMesh& disk);

/// Stage 9: samples a mapped surface at the samples' places in its chart, which is the whole image
/// where it is square; else the image has its longer side, and the chart begins at sample 0.
/// Interior samples come from the triangle that covers them, by exact orientation and a top-left
/// rule; border samples are computed once a path and written to both mates.
/// @post mates_bit_equal
/// @throws TopologyError when an interior sample is not covered exactly once: the map is not valid
GeometryImage sample_image(const MappedDisk& mapped);

/// Unit normals of the surface (angle-weighted at its vertices, interpolated), sampled at a grid of
/// points over the same chart, placed as by sample_image. Mates hold the same bits wherever both
/// are samples, always when rows - 1 is a multiple of the chart's.
NormalMap sample_normals(const MappedDisk& mapped, ChartSize size);
/// @param normals  unit, at the vertices of the disk, instead of its own [D]
NormalMap sample_normals(const MappedDisk& mapped, ChartSize size, std::span<const Vec3d> normals);

/// The mesh's own texture coordinates at the samples of the image, x = u, y = v, z = 0. Each comes
/// from the triangle that contains the sample, so that mates differ where a seam of the texture
/// runs along the cut.
/// @param surface  the mesh that was cut open, with texture coordinates
Planes3 sample_texture(const MappedDisk& mapped, const TriangleMesh& surface);

/// The number of triangles that cover each interior sample under the top-left rule, [rows x cols],
/// border samples 0: all ones when the map is valid. For tests and inspection.
Grid<int> coverage(const MappedDisk& mapped);

}  // namespace weft
