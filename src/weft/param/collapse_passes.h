#pragma once

#include <functional>

#include "weft/param/collapse_hierarchy.h"

namespace weft {

/// What it costs to take away the vertex that a half-edge leaves by collapsing it; infinity: never.
using CollapseCost = std::function<double(const CollapseHierarchy&, int half_edge)>;

/// Squared length of the edge; only where the triangles that move keep about their direction and
/// shape and no vertex gets too many neighbours: the coarse surface is one on which a map compares
/// with that of the fine one.
CollapseCost length_cost(const DiskMesh& disk);
/// How many edges the vertex that stays gets: whatever the surface looks like, all vertices keep
/// about equally many neighbours.
CollapseCost valence_cost();

struct PassOptions {
  int triangles = 0;      ///< it ends when no more are left
  double first_cost = 0;  ///< what a collapse may cost in the first passes
  double growth = 2;      ///< of that, after every pass that took little away
};
/// Takes vertices away in passes, each the cheapest way it can go. Vertices around a collapse stay
/// until the next pass, so that a pass thins the mesh evenly. Ends when nothing can be collapsed at
/// any finite cost.
void collapse_in_passes(CollapseHierarchy& mesh, const CollapseCost& cost,
                        const PassOptions& options);

}  // namespace weft
