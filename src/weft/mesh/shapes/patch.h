#pragma once

#include <functional>

#include "weft/mesh.h"
#include "weft/mesh/shapes/field.h"

namespace weft {

/// The part of a mesh where a field is negative; triangles on its edge are cut, their new vertices
/// where the field, taken as linear along edges, vanishes. Vertices that are left over are dropped.
TriangleMesh clip(const TriangleMesh& mesh, const Field& cut);

/// A cols x rows patch of quads over the unit square. Where it wraps, the last column (row) of
/// vertices is the first.
struct Patch {
  int cols = 0, rows = 0;
  bool wraps_u = false, wraps_v = false;
};

/// The mesh of a map of the square: quads split along their shorter diagonal, counter-clockwise in
/// the (u, v) plane, so that dP/du x dP/dv is the side that faces out.
TriangleMesh patch_mesh(const Patch& patch, const std::function<Vec3d(double u, double v)>& point);

}  // namespace weft
