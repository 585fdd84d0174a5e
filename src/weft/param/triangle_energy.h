#pragma once

#include <array>

#include "weft/param/stretch.h"

namespace weft {

/// The stretch energy area * (a + c) / 2 of one triangle and how it answers to moves of its corners
/// in the plane: gradient and a Hessian that is the sum of three squares, so that it is positive
/// semidefinite. Derivation: weft/param/stretch_newton.h.
struct TriangleEnergy {
  double value = 0;
  std::array<double, 6> gradient{};  ///< u, v of corner 0, 1, 2
  std::array<std::array<double, 6>, 3>
      squares{};  ///< Hessian = sum of outer products of these rows
};
/// @pre the triangle turns left
TriangleEnergy triangle_energy(const SurfaceTriangle& surface, Vec2d a, Vec2d b, Vec2d c);

}  // namespace weft
