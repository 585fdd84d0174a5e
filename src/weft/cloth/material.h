#pragma once

namespace weft {

/// A fabric. Its springs follow the surface, not the grid: see docs/theory.md.
struct Material {
  double density = 0.2;        ///< [kg/m^2]
  double stretch = 2000;       ///< membrane stiffness along rows and columns [N/m]
  double shear = 500;          ///< membrane stiffness along diagonals [N/m]
  double bending = 0;          ///< stiffness against bending, B [N m]
  double bend_springs = 0.5;   ///< stiffness of second-neighbour springs, as given [N/m]
  double damping = 2;          ///< rate at which neighbours' relative motion dies away [1/s]
  double strain_limit = 0.05;  ///< largest elongation that the limiter lets stand; 0: no limiter
  double thickness = 0.002;    ///< [m]
};

}  // namespace weft
