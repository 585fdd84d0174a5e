#pragma once

#include <array>

#include "weft/mesh/stretch.h"

namespace weft {

/// The stretch energy area * (a + c) / 2 of one triangle and how it answers to moves of its corners
/// in the plane: gradient and a Hessian that is the sum of three squares, so that it is positive
/// semidefinite. Derivation: weft/param/stretch_newton.h.
struct TriangleEnergy {
  double value = 0;
  std::array<double, 6> gradient{};  ///< u, v of corner 0, 1, 2
  /// Hessian = sum of outer products of these rows; the fourth is of `weigh_by_curvature` alone,
  /// the last four of `add_inverse_stretch`
  std::array<std::array<double, 6>, 8> squares{};
};
/// @pre the triangle turns left
TriangleEnergy triangle_energy(const SurfaceTriangle& surface, Vec2d a, Vec2d b, Vec2d c);

/// Turns an energy area * m of mean square stretch m into area * (m + quartic * m^2 / 2), with its
/// derivatives: the second term counts for the more the more a triangle is stretched.
/// @param quartic  >= 0
void weigh_by_curvature(TriangleEnergy& energy, double area, double quartic);

/// Adds the inverse term, unit^2 times inverse_weight being `weight`; it is the sum of its squares.
void add_inverse_stretch(TriangleEnergy& energy, const SurfaceTriangle& surface, double weight,
                         const std::array<Vec2d, 3>& corners);

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
