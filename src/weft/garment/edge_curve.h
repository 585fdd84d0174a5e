#pragma once

#include <vector>

#include "weft/garment.h"

namespace weft {

/// An edge of a panel as a fine polyline from its first corner to its last, both included. [m]
std::vector<Vec2d> edge_polyline(const PatternPanel& panel, const PatternEdge& edge);

double length_of(const std::vector<Vec2d>& polyline);

/// Points at equal distances along a polyline. @return intervals + 1 of them, the ends exactly
std::vector<Vec2d> spread_along(const std::vector<Vec2d>& polyline, int intervals);

}  // namespace weft
