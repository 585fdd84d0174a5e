#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/mesh.h"
#include "weft/param/square_map.h"

namespace weft {

/// A point on a mesh: a triangle and its barycentric coordinates there, >= 0 and summing to 1.
struct SurfacePlace {
  int triangle = -1;
  std::array<double, 3> weights{};
};

/// The points of a grid of samples over a map's chart on the mesh that was cut open, which transfer
/// any attribute of the mesh to the image. On the cut, mates are the same point, each in a triangle
/// on its own side.
/// @param surface  [F] the triangles of the mesh that was cut
/// @param size     as much finer than the chart along rows as along columns
/// @return [rows * cols], row by row
std::vector<SurfacePlace> surface_places(const MappedDisk& mapped,
                                         std::span<const Triangle> surface, ChartSize size);

/// The positions of the vertices of a mesh in the chart that it was mapped to, in sample units.
/// @param source_vertex  input vertex of each vertex of the repaired mesh
/// @param vertices       number of vertices of the input
/// @return [vertices] the first of several positions (on the cut, or where fans were split); not
/// finite for vertices that the repaired mesh does not have
std::vector<Vec2d> vertex_places(const MappedDisk& mapped, std::span<const int> source_vertex,
                                 int vertices);

}  // namespace weft
