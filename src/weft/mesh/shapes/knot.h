#pragma once

#include "weft/mesh.h"

namespace weft {

/// A trefoil knot tied of a round tube, lying on the xz plane around the y axis: closed, genus 1.
TriangleMesh knot_mesh();
inline constexpr double knot_tube_radius = 0.06;  ///< [m]
/// The middle line of the tube, closed: t in [0, 1], t = 1 is the start again.
Vec3d knot_point(double t);

}  // namespace weft
