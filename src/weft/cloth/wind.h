#pragma once

#include "weft/cloth/chart_rows.h"
#include "weft/cloth/cloth.h"
#include "weft/core/thread_team.h"
#include "weft/material.h"

namespace weft {

/// [kg/m^3] at 20 degrees and sea level
inline constexpr double air_density = 1.204;

/// Wind forces on the triangles of a cloth, each cell cut into two along its falling diagonal. A
/// triangle of area A and normal n has the relative wind w, the wind's velocity less its own (the
/// mean of its corners'), so cloth that moves with the wind has no force; with n turned to
/// w . n >= 0
///   force = rho/2 A (w . n) (drag w + lift (|w| n - (w . n) w / |w|)),
/// drag along w, lift across it: zero edge on, rho/2 drag A |w|^2 face on. Each corner takes a
/// third.
class Wind {
 public:
  /// @param cloth  kept by reference
  Wind(const WindOptions& options, const Cloth& cloth);

  /// Adds the wind's change of velocity in one step, computed from the state before it, as an
  /// external force beside gravity that no filter sees. Forces that would reverse the relative wind
  /// within the step are damped to first order, so no wind makes a step unstable. Pins keep their
  /// velocity.
  void blow(double time_step, ClothState& state, ThreadTeam& team);

 private:
  void push_triangles_row(float time_step, const ClothState& state, int row);
  void gather_row(int row);
  void kick_row(float time_step, int row, Planes3& velocity) const;

  Vec3f velocity_;
  float drag_, lift_;  // times half the air's density [kg/m^3]
  const Cloth& cloth_;
  // A third of the force on both triangles of cell (r, c) at (r + 1, c + 1), zeros around. [N]
  Planes3 upper_, lower_;
  Planes3 force_;  // [n x n] own parts, then sums over mates [N]
  ChartRows rows_;
};

}  // namespace weft
