#pragma once

#include "weft/mesh/stretch.h"

namespace weft {

/// How much a triangle's inverse stretch counts in the energy, beside area * (m + q m^2 / 2).
///
/// Stretch alone is not rank-one convex where its singular values' ratio exceeds 2 + sqrt(3): it is
/// lowered by shearing neighbouring triangles to and fro, and the map creases. The inverse term,
///   share * unit^2 * area * (1 / s1^2 + 1 / s2^2) / 2,
/// is a convex quadratic of the corners and small but for such shear. With p and q the triangle's
/// edges in the plane it is unit^2 * weight * n, n = g11 |q|^2 - 2 g12 p.q + g22 |p|^2, where unit
/// is the square stretch of a map that keeps areas.
/// @return weight >= 0, bounded for slivers, whose n says little of the map around them [1 / m^2]
double inverse_weight(const SurfaceTriangle& surface);

}  // namespace weft
