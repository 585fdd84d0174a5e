#pragma once

#include "weft/cloth/rest_shape.h"

namespace weft {

/// What free borders add to the Laplacian's energy, so that a saddle is not free of it,
///   -(1 - nu) B integral of (x_uu . x_vv - x_uv . x_uv),  B = sqrt(B_warp B_weft),
/// which for any map is an integral over the border: of x_u . d(x_v), here around the triangles
/// that have an edge on it. With nu = 0 both together are the energy of the whole second
/// derivative, B/2 integral of |x_uu|^2 + 2 |x_uv|^2 + |x_vv|^2, to the last term on a uniform grid
/// [stein18]. Vanishes on affine maps.
/// @param bending  B [N m]
/// @return empty where the rest shape has seams, or triangles on its border that are slivers
BorderBending make_border_bending(const RestShape& shape, double bending);

}  // namespace weft
