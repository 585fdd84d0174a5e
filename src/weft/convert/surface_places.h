#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/mesh.h"
#include "weft/param/square_map.h"

namespace weft {

/// A place on a mesh: a triangle and the weights of its corners, >= 0 and summing to 1.
struct SurfacePlace {
  int triangle = -1;
  std::array<double, 3> weights{};
};

/// Where each of size x size samples of a map lies on the mesh that was cut open, by which anything
/// that the mesh carries comes to the image. On the cut, mates lie at one point but in the
/// triangles of their own sides.
/// @param surface  [F] the triangles of the mesh that was cut
/// @return [size * size], row by row
std::vector<SurfacePlace> surface_places(const MappedDisk& mapped,
                                         std::span<const Triangle> surface, int size);

/// Where the vertices of a mesh lie in the square that it was mapped to, in sample units.
/// @param source_vertex  of each vertex of the repaired mesh, the one that it was in the input
/// @param vertices       how many the input has
/// @return [vertices] of several places (on the cut, or where fans were split) the first; not
/// finite for vertices that the repaired mesh has not
std::vector<Vec2d> vertex_places(const MappedDisk& mapped, std::span<const int> source_vertex,
                                 int vertices);

}  // namespace weft
