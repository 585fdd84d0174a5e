#pragma once

#include "weft/mesh.h"

namespace weft {

/// A closed box around the origin with sharp edges, in squares of 2 cm cut in two.
TriangleMesh box_mesh();
/// [m]
inline constexpr Vec3d box_size{0.6, 0.4, 0.5};

/// An icosahedron whose triangles are split in four `levels` times (20 * 4^levels triangles), every
/// vertex on the sphere around the origin.
/// @param radius  [m], > 0
/// @param levels  >= 0
TriangleMesh icosphere(double radius, int levels);

/// Two rings side by side along x that melt into each other: closed, genus 2.
TriangleMesh double_torus_mesh();
double double_torus_field(Vec3d point);

/// A rounded plate with 5 x 4 round holes, lying around the y axis: closed, genus 20.
TriangleMesh genus20_mesh();
double genus20_field(Vec3d point);

}  // namespace weft
