#pragma once

#include <functional>

#include "weft/param/collapse_hierarchy.h"

namespace weft {

/// The order in which half-edges are collapsed, and which may be.
struct CollapseOrder {
  /// Collapses of lower cost come first.
  std::function<double(const CollapseHierarchy&, int half_edge)> cost;
  /// Whether a collapse is allowed; called only where CollapseHierarchy::can_collapse holds.
  std::function<bool(const CollapseHierarchy&, int half_edge)> allows;
};

/// Shortest edges first. A collapse is rejected where triangles would turn far or become slivers,
/// or where an inner vertex would get too many neighbours, so that maps of the coarse surface
/// resemble those of the fine one.
/// @param disk  must outlive the order
CollapseOrder shortest_first(const DiskMesh& disk);
/// Lowest valence of the remaining vertex first, with every collapse allowed: valences stay even
/// whatever the shape of the surface.
CollapseOrder min_valence_first();

struct PassOptions {
  int triangles = 0;      ///< stop at this number of triangles or fewer
  double first_cost = 0;  ///< maximum cost of a collapse in the first passes
  double growth = 2;  ///< factor on the maximum cost after every pass that collapsed few vertices
};
/// Collapses vertices in passes, each by its cheapest allowed half-edge. The neighbours of a
/// collapsed vertex are skipped until the next pass, so that a pass thins the mesh evenly. Ends at
/// `triangles`, or when nothing can be collapsed at any cost.
void collapse_in_passes(CollapseHierarchy& mesh, const CollapseOrder& order,
                        const PassOptions& options);

}  // namespace weft
