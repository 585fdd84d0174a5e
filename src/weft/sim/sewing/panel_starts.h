#pragma once

#include <span>
#include <vector>

#include "weft/core/thread_team.h"
#include "weft/garment.h"
#include "weft/grid.h"
#include "weft/simulation.h"

namespace weft {

/// Panels that begin elsewhere than a pattern places them.
struct MovedPanels {
  int count = 0;
  int farthest = 0;     ///< number of the panel that was moved farthest
  double distance = 0;  ///< how far that is [m]
};

/// Moves panels that begin inside a closed body or across it outwards, each as a whole along its
/// outer side, as far as it takes to come out and then a little. A body that holds all panels stays
/// round them, and panels that half a metre does not bring out stay where they are.
/// @param panels  gives the triangles, by charts
MovedPanels move_out_of_bodies(const GeometryImage& panels, std::span<const PlacedBody> bodies,
                               ThreadTeam& team, Planes3& placed);

/// Raises panels that stand across one that they are sewn to, above its middle, until all of them
/// is above it: hoods, whose points would hang in the way of straps that go over the shoulders.
/// Panels with a label stay where they are worn, and those that `stay`.
/// @param stay  of each panel
MovedPanels raise_above_others(const Garment& garment, const std::vector<char>& stay,
                               Planes3& placed);

/// Moves panels outwards by millimetres that touch others elsewhere than along their seams: side by
/// side in one plane they would overlap after a step.
/// @return how many panels were moved
int part_panels(const BorderMates& sewn, Planes3& placed);

/// Lifts panels of which a part begins below the ground, each as a whole.
/// @param ground  height of the ground, and what samples keep from it [m]
/// @return how many panels were lifted
int lift_above_ground(const BorderMates& mates, double ground, Planes3& placed);

}  // namespace weft
