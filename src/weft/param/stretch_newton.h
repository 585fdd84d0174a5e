#pragma once

#include <span>

#include "weft/param/border_relaxation.h"
#include "weft/param/disk_geometry.h"
#include "weft/progress.h"

namespace weft {

struct NewtonOptions {
  int steps = 24;  ///< maximum number
  double min_gain =
      2e-3;  ///< relative decrease of the root of the energy in a step below which it ends
  Progress* progress = nullptr;                  ///< told of every step
  std::span<const BorderFreedom> freedoms = {};  ///< the rest of the border is fixed
};

/// Minimises the stretch of a valid map (DiskGeometry::energy: the L2 stretch, a quartic term
/// weighted by curvature and the inverse stretch) by projected Newton steps in all interior
/// vertices at once, and in the border vertices that are free along their sides. These keep their
/// order, since a triangle would degenerate where two met.
///
/// Under a displacement with gradient X (in the plane) a triangle's J becomes J (I + X)^-1, so with
/// the metric G = J^T J its energy is, to second order,
///   area / 2 * ( tr G - 2 tr(G X) + tr(X^T G X) + 2 tr(G X X) ).
/// In the eigenvectors of G, g1 >= g2, the quadratic part is
///   3 g1 x11^2 + 3 g2 x22^2 + g1 x12^2 + g2 x21^2 + 2 (g1 + g2) x12 x21,
/// whose last three terms form a 2 x 2 block with one negative eigenvalue; without that eigenvalue
/// the system is positive definite. The energy is unbounded as a triangle degenerates, and step
/// lengths end before the first one does, so a valid map stays valid.
/// @param uv  [D] a valid map; the border is fixed but for `freedoms`, whose mates stay exactly
/// opposite
void minimise_by_newton(const DiskGeometry& geometry, std::span<Vec2d> uv,
                        const NewtonOptions& options);

}  // namespace weft
