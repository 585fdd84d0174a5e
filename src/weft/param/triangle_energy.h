#pragma once

#include <array>

#include "weft/mesh/stretch.h"

namespace weft {

/// The stretch energy area * tr(G) / 2 of one triangle and its derivatives by the positions of its
/// corners in the plane: the gradient and a Hessian that is a sum of three squares, hence positive
/// semidefinite. Derivation: weft/param/stretch_newton.h.
struct TriangleEnergy {
  double value = 0;
  std::array<double, 6> gradient{};  ///< u, v of corner 0, 1, 2
  /// Hessian = sum of outer products of these rows; the fourth is of `weigh_by_curvature` alone,
  /// the last four of `add_inverse_stretch`
  std::array<std::array<double, 6>, 8> squares{};
};
/// @pre the triangle is positively oriented
TriangleEnergy triangle_energy(const SurfaceTriangle& surface, Vec2d a, Vec2d b, Vec2d c);

/// Adds the quartic term: turns an energy area * m of mean square stretch m into
/// area * (m + quartic * m^2 / 2), with its derivatives. The term penalises strong stretch.
/// @param quartic  >= 0
void weigh_by_curvature(TriangleEnergy& energy, double area, double quartic);

/// Adds the inverse stretch term, a sum of squares.
/// @param weight  unit^2 times inverse_weight
void add_inverse_stretch(TriangleEnergy& energy, const SurfaceTriangle& surface, double weight,
                         const std::array<Vec2d, 3>& corners);

/// Weight of a triangle's inverse stretch in the energy, beside area * (m + q m^2 / 2).
///
/// Stretch alone is not rank-one convex where the ratio of its singular values exceeds 2 + sqrt(3):
/// shearing neighbouring triangles in alternating directions lowers it, and the map creases. The
/// inverse term,
///   share * unit^2 * area * (1 / s1^2 + 1 / s2^2) / 2,
/// is a convex quadratic of the corners and small except for such shear. With p and q the
/// triangle's edges in the plane it is unit^2 * weight * n, n = g11 |q|^2 - 2 g12 p.q + g22 |p|^2,
/// where unit is the mean square stretch of an area-preserving map.
/// @return weight >= 0, bounded for slivers, whose n says little of the map around them [1 / m^2]
double inverse_weight(const SurfaceTriangle& surface);

}  // namespace weft
