#pragma once

#include <functional>

#include "weft/param/collapse_hierarchy.h"

namespace weft {

/// Which vertices go first, each by collapsing a half-edge that leaves it.
struct CollapseOrder {
  /// The less, the sooner.
  std::function<double(const CollapseHierarchy&, int half_edge)> cost;
  /// Asked last, and only where the topology allows it.
  std::function<bool(const CollapseHierarchy&, int half_edge)> allows;
};

/// Shortest edges first; only where the triangles that move keep about their direction and shape
/// and no vertex gets too many neighbours: the coarse surface is one on which a map compares with
/// that of the fine one.
/// @param disk  must outlive the order
CollapseOrder shortest_first(const DiskMesh& disk);
/// By how many edges the vertex that stays gets, always allowed: whatever the surface looks like,
/// all vertices keep about equally many neighbours.
CollapseOrder min_valence_first();

struct PassOptions {
  int triangles = 0;      ///< it ends when no more are left
  double first_cost = 0;  ///< what a collapse may cost in the first passes
  double growth = 2;      ///< of that, after every pass that took little away
};
/// Takes vertices away in passes, each the cheapest way it can go. Vertices around a collapse stay
/// until the next pass, so that a pass thins the mesh evenly. Ends when nothing can be collapsed at
/// any cost.
void collapse_in_passes(CollapseHierarchy& mesh, const CollapseOrder& order,
                        const PassOptions& options);

}  // namespace weft
