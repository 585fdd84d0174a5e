#pragma once

#include "weft/cloth/rest_shape.h"

namespace weft {

/// The bending planes of a rest shape, see BendingPlanes. The weights of L around a particle are
/// the nearest to the five-point stencil (by least squares) that vanish on affine functions of the
/// tangent plane and have the second moments of a Laplacian there, so that L does not depend on how
/// the surface is parameterized, to second order in the spacing. Particles whose neighbours do not
/// span a plane get none.
BendingPlanes make_bending(const RestShape& shape, const Material& material);

}  // namespace weft
