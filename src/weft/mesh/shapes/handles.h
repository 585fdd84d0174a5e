#pragma once

#include "weft/mesh.h"

namespace weft {

/// Two rings side by side along x that melt into each other: closed, genus 2.
TriangleMesh double_torus_mesh();
double double_torus_field(Vec3d point);

/// A rounded plate with 5 x 4 round holes, lying around the y axis: closed, genus 20.
TriangleMesh genus20_mesh();
double genus20_field(Vec3d point);

}  // namespace weft
