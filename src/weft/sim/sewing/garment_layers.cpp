#include "weft/sim/sewing/garment_layers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "weft/sim/sewing/panel_moves.h"

namespace weft {
namespace {

/// How much farther outside the panels of a garment begin than those of the one below it. [m]
constexpr double layer_distance = 0.05;
/// Cosine of the angle between their sides up to which panels face the same way.
constexpr double cosine_same = 0.7;

struct Extent {
  double lower = HUGE_VAL, upper = -HUGE_VAL;

  [[nodiscard]] bool overlaps(const Extent& other) const {
    return lower < other.upper && other.lower < upper;
  }
};

Extent extent_of(const Chart& panel, const Planes3& placed, Vec3d axis) {
  Extent extent;
  for (int r = panel.row; r < panel.row + panel.rows; ++r)
    for (int c = panel.col; c < panel.col + panel.cols; ++c) {
      const double along = dot(axis, vec_cast<double>(placed.at(r, c)));
      extent.lower = std::min(extent.lower, along);
      extent.upper = std::max(extent.upper, along);
    }
  return extent;
}

/// Two axes across a panel's outer side: along the horizontal, where there is one, and up.
std::array<Vec3d, 2> axes_across(Vec3d outer) {
  const Vec3d up = std::abs(outer.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1};
  const Vec3d along = normalized(cross(up, outer));
  return {along, cross(outer, along)};
}

/// How far a panel has to go out to be clear of one below, if it covers that; or less than none.
double way_out(const Chart& panel, const Planes3& placed, const Chart& below,
               const Planes3& below_placed) {
  const Vec3d outer = outer_side(panel, placed);
  if (dot(outer, outer_side(below, below_placed)) < cosine_same) return 0;
  for (const Vec3d& axis : axes_across(outer))
    if (!extent_of(panel, placed, axis).overlaps(extent_of(below, below_placed, axis))) return 0;
  return extent_of(below, below_placed, outer).upper - extent_of(panel, placed, outer).lower +
         layer_distance;
}

}  // namespace

void put_round_layers(const BorderMates& mates, int layer, std::span<const GarmentBelow> below,
                      Planes3& placed) {
  double way = layer * layer_distance;
  for (const GarmentBelow& garment : below)
    for (const Chart& lower : garment.mates.charts())
      for (const Chart& panel : mates.charts())
        way = std::max(way, way_out(panel, placed, lower, garment.placed));
  std::vector<Vec3d> shift;
  for (const Chart& panel : mates.charts()) shift.push_back(way * outer_side(panel, placed));
  move_panels(mates, shift, placed);
}

}  // namespace weft
