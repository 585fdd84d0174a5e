#pragma once

#include "weft/vec.h"

namespace weft {

/// A quantity of a fabric along each of its thread systems: the warp runs along rows of the image
/// (u), the weft along columns (v).
struct WarpWeft {
  double warp = 0, weft = 0;

  constexpr WarpWeft() = default;
  /// The same value along both: one number for a fabric without a preferred direction.
  constexpr WarpWeft(double both)
      : warp(both), weft(both) {}  // NOLINT(google-explicit-constructor)
  constexpr WarpWeft(double along_rows, double along_columns)
      : warp(along_rows), weft(along_columns) {}

  friend constexpr bool operator==(WarpWeft a, WarpWeft b) = default;
};

/// A fabric. Its springs follow the surface, not the grid: see docs/theory.md.
struct Material {
  double density = 0.2;      ///< [kg/m^2]
  WarpWeft stretch = 20000;  ///< membrane stiffness along rows and columns [N/m]
  /// Membrane stiffness along diagonals: twice the modulus against shear between warp and weft
  /// [N/m].
  double shear = 100;
  WarpWeft bending = 1e-5;  ///< stiffness against bending, B [N m]
  /// Stiffness of second-neighbour springs, as given: the model of [zink07], which fades as the
  /// grid is refined [N/m].
  double bend_springs = 0;
  double damping = 2;  ///< decay rate of the relative velocity of neighbours [1/s]
  /// Elongation of stretch springs beyond which `newton` adds ten times their stiffness, and down
  /// to which the limiter of other methods corrects them; 0: none.
  double strain_limit = 0;
  double thickness = 0.002;  ///< [m]
};

/// Air that moves past the cloth.
struct WindOptions {
  Vec3d velocity;  ///< [m/s]
  double drag = 1, lift = 1;
};

}  // namespace weft
