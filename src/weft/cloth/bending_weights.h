#pragma once

#include "weft/cloth/rest_shape.h"

namespace weft {

/// The bending planes of a rest shape, see BendingPlanes. The weights of L around a particle are
/// the nearest to the five-point stencil (by least squares) that vanish on affine functions of the
/// tangent plane and have the second moments of
///   sqrt(B_warp) d^2/du^2 + sqrt(B_weft) d^2/dv^2
/// there, u along the rows at rest and v at right angles to them. So L depends on the
/// parameterization of the surface only by the direction of its rows, to second order in the
/// spacing. Particles whose neighbours do not span a plane have no weights.
BendingPlanes make_bending(const RestShape& shape, const Material& material);

}  // namespace weft
